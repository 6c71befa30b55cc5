// Ports are read in place: nothing is copied until somebody looks.
#include "engine/trace/channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "engine/ports/payload.hpp"
#include "engine/trace/series.hpp"

namespace nezumi {

namespace {

constexpr std::uint64_t no_version = ~std::uint64_t{0};
constexpr double dust = 1e-9;  // [m], [rad], [m/s], [rad/s]

// Where the first name of a path ends.
std::size_t end_of_name(std::string_view path) { return std::min(path.find_first_of(".["), path.size()); }

// Why values of a type, called `whole`, have no part ".name", "[2]" or "[2].name"; "" when they have.
std::string no_such_part(const Type& type, std::string_view part, const std::string& whole) {
    if (part.empty()) return "";
    if (type.kind == Type::Kind::sequence) {
        const std::size_t close = part.find(']');
        std::size_t index = 0;
        if (part.front() == '[' && close != std::string_view::npos)
            std::from_chars(part.data() + 1, part.data() + close, index);
        if (index == 0) return fmt::format("{} is a list: {}[1] is its first element", whole, whole);
        return no_such_part(*type.element, part.substr(close + 1), whole + std::string(part.substr(0, close + 1)));
    }
    if (part.front() == '.') part.remove_prefix(1);
    if (type.kind != Type::Kind::structure)
        return fmt::format("{} is a single value: it has no '{}'", whole, shown(part));
    const std::string_view head = part.substr(0, end_of_name(part));
    std::vector<std::string_view> names;
    for (const Type::Field& field : type.fields) {
        if (field.name == head)
            return no_such_part(*field.type, part.substr(head.size()), fmt::format("{}.{}", whole, head));
        names.push_back(field.name);
    }
    return fmt::format("{} has no '{}'{}", whole, shown(head), did_you_mean(head, names));
}

void visit_parameters(const Parameters& parameters, const LeafVisitor& visit) {
    for (const auto& parameter : parameters.all()) {
        const LeafPath root, path = root.field(parameter.spec.name);
        visit_leaves(parameter.value, visit, path);
    }
}

}  // namespace

bool is_within(std::string_view path, std::string_view part) {
    return part.empty() || (path.starts_with(part) &&
                            (path.size() == part.size() || path[part.size()] == '.' || path[part.size()] == '['));
}

Truth seen_truth(const World& world, RobotId robot) {
    Truth truth = world.truth(robot);
    for (double* value : {&truth.pose.position.x, &truth.pose.position.y, &truth.pose.heading, &truth.velocity.vx,
                          &truth.velocity.vy, &truth.velocity.va, &truth.height, &truth.tilt}) {
        if (std::abs(*value) < dust) *value = 0;
    }
    return truth;
}

Channel::Channel(std::string_view owner, std::string_view member, std::string_view part)
    : owner_(owner), member_(member), part_(part) {
    name_ = owner_ + "." + member_;
    if (!part_.empty()) name_ += part_.front() == '[' ? part_ : "." + part_;
}

Expected<Channel> Channel::find(const System& system, std::string_view name) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    std::string_view rest = name.substr(std::min(dot + 1, name.size()));
    const std::string_view member = rest.substr(0, end_of_name(rest));
    rest.remove_prefix(member.size());
    if (rest.starts_with('.')) rest.remove_prefix(1);
    if (dot == 0 || member.empty()) return Unexpected(system.port(name).error());
    const Component* owner = system.find(name.substr(0, dot));
    if (owner == nullptr) return Unexpected(system.port(name).error());
    Channel channel(owner->name(), member, rest);
    channel.resolve(system);
    if (auto ok = channel.check(system, *owner); !ok) return Unexpected(ok.error());
    // What a tick that has passed left can still be read.
    if (system.now().tick > 0) channel.latch(system, system.now().tick - 1);
    return channel;
}

Expected<void> Channel::check(const System& system, const Component& owner) const {
    const std::string whole = owner_ + "." + member_;
    const std::string part = part_.empty() || part_.front() == '[' ? part_ : "." + part_;
    const auto checked = [&](const Type& type) -> Expected<void> {
        std::string why = no_such_part(type, part, whole);
        return why.empty() ? Expected<void>() : failure(std::move(why));
    };
    switch (kind_) {
        case Kind::out_port:
        case Kind::in_port: return checked(*message_infos()[port_->type()].payload);
        case Kind::truth: return checked(type_of<Truth>());
        case Kind::collided: return checked(type_of<bool>());
        case Kind::config: {
            const std::string_view parameter = std::string_view(part_).substr(0, end_of_name(part_));
            std::vector<std::string_view> names;
            for (const auto& each : owner.parameters().all()) names.push_back(each.spec.name);
            if (parameter.empty() || std::find(names.begin(), names.end(), parameter) != names.end()) return {};
            return failure(
                fmt::format("{}: unknown parameter '{}'{}", owner_, shown(parameter), did_you_mean(parameter, names)));
        }
        case Kind::member: return {};
        case Kind::none: break;
    }
    if (member_ == "truth" || member_ == "collided") {
        const bool is_robot = dynamic_cast<const Robot*>(&owner) != nullptr;
        return failure(fmt::format("{} has no {}: it is {}", owner_, member_, is_robot ? "not simulated" : "no robot"));
    }
    std::vector<std::string_view> names;
    for (const auto& port : owner.in_ports()) names.push_back(port->name());
    for (const auto& port : owner.out_ports()) names.push_back(port->name());
    for (const std::string_view other : {"collided", "config", "probes", "state", "tasks", "truth"}) {
        Channel tried(owner_, other, "");
        tried.resolve(system);
        if (tried.kind_ != Kind::none) names.push_back(other);
    }
    return failure(fmt::format("{} has no port '{}'{}", owner_, shown(member_), did_you_mean(member_, names)));
}

std::string Channel::name_of(const LeafPath& path) const {
    const std::string leaf = path.text();
    const bool joined = leaf.empty() || leaf.front() == '[';
    return owner_ + "." + member_ + (joined ? "" : ".") + leaf;
}

void Channel::resolve(const System& system) {
    component_ = system.find(owner_);
    port_ = component_ != nullptr ? component_->find_port(member_) : nullptr;
    kind_ = Kind::none;
    has_value_ = false;
    fresh_ = 0;
    config_version_ = no_version;
    if (component_ == nullptr) return;
    if (port_ != nullptr) {
        kind_ = port_->direction() == Direction::out ? Kind::out_port : Kind::in_port;
        has_value_ = port_->count() > 0;
        if (kind_ == Kind::in_port) static_cast<const InPortBase*>(port_)->follow();
    } else if (member_ == "truth" || member_ == "collided") {
        const auto* robot = dynamic_cast<const Robot*>(component_);
        if (robot != nullptr && robot->has_body() && !robot->is_real() && system.world() != nullptr)
            kind_ = member_ == "truth" ? Kind::truth : Kind::collided;
    } else if (member_ == "config") {
        kind_ = Kind::config;
    } else if (component_->visit_member(member_, [](const LeafPath&, const ValueView&) {})) {
        kind_ = Kind::member;
    }
}

void Channel::latch(const System& system, std::int64_t tick) {
    fresh_ = 0;
    switch (kind_) {
        case Kind::none: return;
        case Kind::out_port:
        case Kind::in_port: {
            const std::int64_t latest = kind_ == Kind::out_port ? static_cast<const OutPortBase*>(port_)->latched_tick()
                                                                : static_cast<const InPortBase*>(port_)->arrival_tick();
            if (latest != tick) return;
            fresh_ = port_->message_count();
            break;
        }
        case Kind::truth:
            truth_ = seen_truth(*system.world(), static_cast<const Robot*>(component_)->id());
            fresh_ = 1;
            break;
        case Kind::collided:
            collided_ = system.world()->collided(static_cast<const Robot*>(component_)->id());
            fresh_ = 1;
            break;
        case Kind::config:
            if (component_->parameters().version() == config_version_) return;
            config_version_ = component_->parameters().version();
            fresh_ = 1;
            break;
        case Kind::member: fresh_ = 1; break;
    }
    if (fresh_ == 0) return;  // an in-port that is followed only since then
    has_value_ = true;
    ++turn_;
}

void Channel::visit(std::size_t message, const LeafVisitor& given) const {
    const LeafVisitor within = [&](const LeafPath& path, const ValueView& leaf) {
        if (is_within(path.text(), part_)) given(path, leaf);
    };
    const LeafVisitor& visit = part_.empty() ? given : within;
    switch (kind_) {
        case Kind::none: return;
        case Kind::out_port:
        case Kind::in_port: return visit_leaves(port_->message(message).data, visit);
        case Kind::truth: return visit_leaves(truth_, visit);
        case Kind::collided: return visit_leaves(collided_, visit);
        case Kind::config: return visit_parameters(component_->parameters(), visit);
        case Kind::member: component_->visit_member(member_, visit); return;
    }
}

void Channel::visit_latest(const LeafVisitor& given) const {
    if (port_ == nullptr || fresh_ > 0) return visit(fresh_ > 0 ? fresh_ - 1 : 0, given);
    const Value value = port_->value();
    visit_leaves(value, [&](const LeafPath& path, const ValueView& leaf) {
        if (part_.empty() || is_within(path.text(), part_)) given(path, leaf);
    });
}

bool Channel::has_pictures() const { return port_ != nullptr && port_->type() == type_index<CameraImage>(); }

void Channel::append_to(Series& series, double seconds) const {
    // What holds its value has one before it changes.
    const std::size_t messages_now = exists() && holds() && series.size() == 0 ? 1 : fresh_;
    if (messages_now == 0) return;
    std::array<double, Series::most_values> values;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
    std::size_t count = 0;
    const auto is_text = [](const ValueView& leaf) { return leaf.type->kind == Type::Kind::text; };
    const auto number_of = [&](const ValueView& leaf) {
        if (is_text(leaf)) return static_cast<double>(series.place_of(leaf.as<std::string>()));
        return visit_number(leaf, [](const auto& number) { return static_cast<double>(number); });
    };
    const auto add = [&](std::size_t message, double at) {
        if (count > series.labels().size()) {
            std::vector<std::string> labels;
            std::vector<bool> are_texts;
            visit(message, [&](const LeafPath& path, const ValueView& leaf) {
                if (labels.size() == values.size()) return;
                labels.push_back(path.text());
                are_texts.push_back(is_text(leaf));
            });
            series.set_labels(std::move(labels), std::move(are_texts));
        }
        series.add(at, {values.data(), count});
        count = 0;
    };
    for (std::size_t i = 0; i < messages_now; ++i) {
        visit(i, [&](const LeafPath&, const ValueView& leaf) {
            if (count < values.size()) values[count++] = number_of(leaf);
        });
        add(i, port_ != nullptr && part_.empty() ? port_->message(i).tm : seconds);
    }
}

}  // namespace nezumi
