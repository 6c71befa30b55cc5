// A port of the node is named after its topic: "/scan/front" has the port scan_front.
#include "bindings/dds/ros/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/dds/ros/convert.hpp"
#include "bindings/dds/ros/type_hash.hpp"
#include "engine/system/published.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::dds {
namespace {

// Messages that may wait for sending within a tick.
constexpr std::size_t most_queued = 32;

std::string port_name(std::string_view topic) {
    std::string name(topic.substr(1));
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

}  // namespace

RosNode::RosNode(const System& system, const RosSpec& spec, DdsTransport& transport, RosNodeSettings settings)
    : Device(fmt::format("ros/{}", spec.node), "RosNode"),
      system_(system),
      transport_(transport),
      settings_(std::move(settings)) {
    place = spec.place;
}

Expected<RosNode*> RosNode::add(System& system, const RosSpec& spec, DdsTransport& transport,
                                RosNodeSettings settings) {
    auto made = std::unique_ptr<RosNode>(new RosNode(system, spec, transport, std::move(settings)));
    RosNode* node = made.get();
    for (const RosTopic& topic : spec.publish) {
        if (auto ok = node->make_port(system, topic, true); !ok) return Unexpected(ok.error());
    }
    for (const RosTopic& topic : spec.subscribe) {
        if (auto ok = node->make_port(system, topic, false); !ok) return Unexpected(ok.error());
    }
    if (auto added = system.add(std::move(made)); !added) return Unexpected(added.error());
    for (const Line& line : node->lines_) {
        const std::string own = path(*node, *line.port);
        const bool publishes = line.port->direction() == Direction::in;
        const auto connected = publishes ? system.connect(line.said.port, own) : system.connect(own, line.said.port);
        if (!connected) return failure(fmt::format("ros: {}", connected.error().message), line.said.place);
    }
    if (auto active = node->activate(system.now()); !active) return Unexpected(active.error());
    return node;
}

Expected<void> RosNode::make_port(System& system, const RosTopic& topic, bool publishes) {
    const auto refuse = [&](std::string_view why) {
        return failure(fmt::format("ros: {}: {}", publishes ? topic.port : topic.topic, why), topic.place);
    };
    const auto other = system.port(topic.port);
    if (!other) return refuse(other.error().message);
    if (((*other)->direction() == Direction::out) != publishes)
        return refuse(publishes ? "an in-port can't be published" : "an out-port can't receive messages from a topic");
    const MessageType* const type = (*other)->type();
    const auto mapping = ros::find_mapping(type, topic.type, !publishes);
    if (!mapping) return refuse(mapping.error().message);
    const std::string name = port_name(topic.topic);
    if (find_port(name) != nullptr) return refuse(fmt::format("the topic {} exists already", topic.topic));
    const std::string doc = fmt::format("{}, {}", topic.topic, mapping->type);
    if (publishes) {
        const bool newest = type == message_of<Velocity2D>() || type == message_of<CameraImage>();
        in_ports_.push_back(make_in_port(type, name, doc, newest ? 0 : most_queued));
    } else {
        out_ports_.push_back(make_out_port(type, name, doc));
    }
    lines_.push_back({topic, *mapping, find_port(name)});
    return {};
}

void RosNode::open() {
    opened_ = true;
    const auto tell = [&] { log(LogLevel::error, transport_.problem()); };
    for (const Line& line : lines_) {
        const bool publishes = line.port->direction() == Direction::in;
        const Topic topic = ros::topic_of(line.said.topic, line.mapping, publishes);
        if (publishes) {
            auto writer = transport_.write(topic);
            if (writer == nullptr) {
                tell();
                continue;
            }
            const std::string frame = line.said.frame.empty() ? std::string(line.mapping.frame) : line.said.frame;
            auto& port = static_cast<InPortBase&>(*line.port);
            publications_.push_back({&port, line.mapping.publish(port, std::move(writer), frame)});
        } else {
            auto reader = transport_.read(topic);
            if (reader == nullptr) {
                tell();
                continue;
            }
            subscriptions_.push_back({line.port, line.mapping.subscribe(std::move(reader))});
        }
    }
    if (system_.settings().real_time) return;
    clock_ = transport_.write({.name = "rt/clock",
                               .type = ros::dds_type_name(Describe<ros::Clock>::name),
                               .reliable = false,
                               .user_data = fmt::format("typehash={};", ros::type_hash(type_of<ros::Clock>()))});
}

// In a simulation, stamps are the simulated time, which /clock publishes; otherwise they are the time of day.
double RosNode::offset(const Time& now) const {
    return system_.settings().real_time ? settings_.wall_clock() - now.seconds : 0;
}

double RosNode::stamp() const { return system_.now().seconds + offset(system_.now()); }

void RosNode::before_tick(const MessageDoor& deliver) {
    const double clock = settings_.clock();
    if (!opened_) {
        open();
        received_at_ = clock;
    }
    // Without ticks, waiting velocities become too old. So after a gap they are dropped, except in a simulation whose
    // gap only means that it is slow.
    const bool waited = std::exchange(turns_, 0) > 1 || system_.settings().real_time;
    const bool stood = clock - std::exchange(received_at_, clock) > silence + 2 / system_.settings().rate && waited;
    for (Taken& taken : subscriptions_) {
        const std::string problem = taken.subscription->receive(clock, [&](Value value) {
            if (state() != LifeState::active || (stood && value.is<Velocity2D>())) return;
            static_cast<void>(
                deliver(*taken.port, Write{path(*this, *taken.port), std::move(value)}, {Actor::Kind::network, "ros"}));
        });
        if (problem.empty() || problem == taken.told) continue;
        taken.told = problem;
        log(LogLevel::warn, fmt::format("a message was rejected: {}", problem));
    }
}

void RosNode::actuate(const Time& now) {
    if (state() != LifeState::active) return;
    send_clock(now);
    const double clock = settings_.clock();
    for (Given& given : publications_) {
        if (given.port->is_new()) given.sent_at = clock;
        if (system_.is_stopped() && commands_robots(given)) {
            given.publication->send_zero(stamp());
        } else {
            given.publication->send(offset(now), measured_by(given));
        }
    }
}

const Velocity2D* RosNode::measured_by(const Given& given) const {
    if (given.port->type() != message_of<Pose2D>()) return nullptr;
    for (const OutPortBase* source : given.port->sources()) {
        for (const Robot* robot : system_.robots()) {
            if (robot->find_port(source->name()) == source) return &robot->measured();
        }
    }
    return nullptr;
}

bool RosNode::commands_robots(const Given& given) const {
    if (given.port->type() != message_of<Velocity2D>()) return false;
    const auto sources = given.port->sources();
    return sources.empty() || std::any_of(sources.begin(), sources.end(), [this](const OutPortBase* source) {
               return nezumi::commands_robots(system_, *source);
           });
}

// Sends velocity 0 if no new velocity came: a ROS robot may drive forever with the last velocity that it received.
void RosNode::between_ticks() {
    ++turns_;
    const double clock = settings_.clock();
    for (const Given& given : publications_) {
        if (given.publication->moves() && clock - given.sent_at > silence) given.publication->send_zero(stamp());
    }
}

Expected<void> RosNode::on_deactivated() {
    for (const Given& given : publications_) {
        if (given.publication->moves()) given.publication->send_zero(stamp());
    }
    return {};
}

void RosNode::send_clock(const Time& now) {
    if (clock_ == nullptr) return;
    write_cdr(bytes_, {.order = std::endian::little, .header = true}, ros::Clock{ros::to_time(now.seconds)});
    static_cast<void>(clock_->write(bytes_));
}

}  // namespace nezumi::dds
