// Poses are small and always sent; a port is read only after new messages.
#include "bindings/web/state_reader.hpp"

#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "engine/trace/channel.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::web {
namespace {

void add_robots(WebFrame& frame, const System& system, const Watch& wanted) {
    const World* const world = system.world();
    std::uint32_t index = 0;
    for (const Robot* robot : system.robots()) {
        const bool simulated = world != nullptr && robot->has_body() && !robot->is_real();
        if (wanted.truth) {
            WebRobot seen{.index = index};
            if (simulated) {
                const auto [position, orientation] = world->pose(robot->id());
                seen = {.index = index,
                        .x = position.x,
                        .y = position.y,
                        .z = position.z,
                        .yaw = orientation.y,
                        .pitch = orientation.p,
                        .roll = orientation.r,
                        .is_truth = true,
                        .collided = world->collided(robot->id()),
                        .touches = world->collided_with(robot->id()),
                        .contacts = world->contact_points(robot->id())};
            } else {
                const Pose2D& pose = robot->odometry().pose();
                seen.x = pose.position.x;
                seen.y = pose.position.y;
                seen.yaw = pose.heading;
            }
            frame.robots.push_back(seen);
        }
        if (wanted.rays && simulated) {
            for (const Ray& ray : world->rays(robot->id())) {
                frame.rays.push_back({.robot = index,
                                      .from = ray.from,
                                      .to = ray.to,
                                      .hit = ray.hit,
                                      .distance = static_cast<std::uint32_t>(ray.distance)});
            }
        }
        ++index;
    }
}

void add_things(WebFrame& frame, const World& world) {
    std::uint32_t index = 0;
    for (const ThingPose& thing : world.things()) frame.things.push_back({.index = index++, .pose = thing.pose});
    index = 0;
    for (const MarkerPose& marker : world.markers()) frame.markers.push_back({.index = index++, .pose = marker.pose});
}

// The largest number of values shown per member.
constexpr std::size_t most_leaves = 128;

std::optional<double> number_of(const ValueView& leaf) {
    if (leaf.type->kind == Type::Kind::text) return std::nullopt;
    return visit_number(leaf, [](const auto& number) { return static_cast<double>(number); });
}

}  // namespace

std::unique_ptr<State> StateReader::at(std::unique_ptr<State> state, const Watch& wanted, double late) {
    const System& system = live_.system();
    if (starts_ != live_.generation() || layout_ != system.layout() || number_ == 0) {
        starts_ = live_.generation();
        layout_ = system.layout();
        ++number_;
        counts_.clear();
        state.reset();
    }
    // If the watched set changes, all watched values are read again: a browser may lack values that others already
    // have.
    if (!(watched_ == wanted)) {
        watched_ = wanted;
        counts_.clear();
    }
    if (state == nullptr) state = std::make_unique<State>();
    state->layout = number_;
    WebFrame frame{.time = system.now().seconds,
                   .tick = system.now().tick,
                   .running = !clock_.is_paused(),
                   .speed = clock_.speed(),
                   .late = late * 1000};
    add_robots(frame, system, wanted);
    if (system.world() != nullptr) add_things(frame, *system.world());
    state->now = std::move(frame);
    add_ports(*state, wanted);
    add_members(*state, wanted);
    return state;
}

void StateReader::add_members(State& state, const Watch& wanted) const {
    state.members.clear();
    for (const std::string& name : wanted.members) {
        auto channel = Channel::find(live_.system(), name);
        if (!channel || channel->is_port()) continue;
        channel->latch(live_.system().now().tick);
        WebMember member{.name = name};
        channel->visit_latest([&](const LeafPath& path, const ValueView& leaf) {
            if (member.leaves.size() >= most_leaves) return;
            if (const auto value = number_of(leaf)) member.leaves.push_back({path.text(), *value});
        });
        state.members.push_back(std::move(member));
    }
}

void StateReader::add_ports(State& state, const Watch& wanted) {
    for (const std::string& name : wanted.ports) {
        const auto port = live_.system().port(name);
        if (!port || (*port)->type() == message_of<CameraImage>()) continue;
        const auto [seen, is_new] = counts_.try_emplace(name, 0);
        const std::uint64_t count = (*port)->count();
        if (!is_new && seen->second == count) continue;
        seen->second = count;
        State::Port& told = state.ports[name];
        told.count = count;
        write_cdr_message(told.payload, (*port)->value(), (*port)->tm());
    }
}

}  // namespace nezumi::web
