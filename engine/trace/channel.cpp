// Reads ports in place, without a copy.
#include "engine/trace/channel.hpp"

#include <fmt/format.h>

#include <array>

#include "engine/ports/payload.hpp"
#include "engine/trace/series.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {

namespace {

constexpr std::uint64_t no_version = ~std::uint64_t{0};
// Whether a channel can carry the value of this node: numbers, booleans or texts; plain data only of scripts.
bool is_carried(const TreeNode& node) {
    switch (node.kind()) {
        case TreeNode::Kind::port:
        case TreeNode::Kind::config:
        case TreeNode::Kind::parameter: return true;
        case TreeNode::Kind::data: return node.component()->script_file() != nullptr;
        case TreeNode::Kind::truth:
        case TreeNode::Kind::value: return node.value().has_value();
        default: return false;
    }
}

// The part of the value that the channel carries. Of a probe only the value, not its time: `probes.error.value` is
// "error".
std::string carried_part(const TreeNode& node) {
    std::string part = node.part();
    if (node.member() == nullptr || node.member()->name != "probes") return part;
    std::string_view rest = part;
    std::string probe(take_step(rest));
    if (std::string_view behind = rest; take_step(behind) == "value") rest = behind;
    return join_path(std::move(probe), rest);
}

// The error that a component has no channel with this name.
Error no_such(const TreeNode& owner, std::string_view name) {
    const Component& component = *owner.component();
    const MemberInfo* member = find_member(component_members(), name);
    if (member != nullptr && member->robot && !member->called && owner.robot() == nullptr)
        return {fmt::format("{} has no {}: it is not a robot", component.name(), name), {}};
    std::vector<std::string> names = changing_members(owner);
    for (const Port* port : ports_of(component)) names.push_back(port->name());
    return {fmt::format("{} has no port '{}'{}", component.name(), shown(name),
                        did_you_mean(name, {names.begin(), names.end()})),
            {}};
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

std::vector<std::string> changing_members(const TreeNode& component) {
    std::vector<std::string> names;
    for (const MemberInfo& each : component_members()) {
        const bool changes = !each.called && (each.kind != TreeNode::Kind::value || each.robot);
        const auto child = changes ? component.child(each.name) : failure("");
        if (child && child->member() == &each && is_carried(*child)) names.emplace_back(each.name);
    }
    return names;
}

Expected<Channel> Channel::find(const System& system, std::string_view name) {
    std::string_view rest = name;
    const auto owner = TreeNode(system).child(take_step(rest));
    if (!owner || rest.empty()) return Unexpected(system.port(name).error());
    std::string_view below = rest;
    const std::string_view member = take_step(below);
    const auto child = owner->child(member);
    if (!child) return Unexpected(no_such(*owner, member));
    const auto node = child->find(below);
    if (!node) return Unexpected(node.error());
    if (node->kind() == TreeNode::Kind::truth || node->kind() == TreeNode::Kind::value) {
        if (auto value = node->value(); !value) return Unexpected(value.error());
    }
    if (!is_carried(*node)) return Unexpected(no_such(*owner, member));
    Channel channel(node->whole(), carried_part(*node));
    channel.resolve(system);
    // A new channel begins with the values of the last tick, which can still be read.
    if (system.now().tick > 0) channel.latch(system.now().tick - 1);
    return channel;
}

std::string Channel::name_of(const LeafPath& path) const { return join_path(whole_, path.text()); }

void Channel::resolve(const System& system) {
    kind_ = Kind::none;
    has_value_ = false;
    fresh_ = 0;
    config_version_ = no_version;
    const auto node = TreeNode(system).find(whole_);
    node_.reset();
    if (!node || !is_carried(*node)) return;
    node_ = *node;
    switch (node->kind()) {
        case TreeNode::Kind::port: {
            const Port& port = *node->port();
            kind_ = port.direction() == Direction::out ? Kind::out_port : Kind::in_port;
            has_value_ = port.count() > 0;
            if (kind_ == Kind::in_port) static_cast<const InPortBase&>(port).follow();
            return;
        }
        case TreeNode::Kind::config: kind_ = Kind::config; return;
        case TreeNode::Kind::data: kind_ = Kind::data; return;
        default: kind_ = Kind::value;
    }
}

void Channel::latch(std::int64_t tick) {
    fresh_ = 0;
    switch (kind_) {
        case Kind::none: return;
        case Kind::out_port:
        case Kind::in_port: {
            const Port* port = node_->port();
            const std::int64_t latest = kind_ == Kind::out_port ? static_cast<const OutPortBase*>(port)->latched_tick()
                                                                : static_cast<const InPortBase*>(port)->arrival_tick();
            if (latest != tick) return;
            fresh_ = port->message_count();
            break;
        }
        case Kind::config: {
            const std::uint64_t version = node_->component()->parameters().version();
            if (std::exchange(config_version_, version) == version) return;
            fresh_ = 1;
            break;
        }
        case Kind::value: {
            auto value = node_->value();
            if (!value) return;
            value_ = std::move(*value);
            fresh_ = 1;
            break;
        }
        case Kind::data: fresh_ = 1; break;
    }
    if (fresh_ == 0) return;  // the in-port was not followed yet when the messages came
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
        case Kind::in_port: return visit_leaves(node_->port()->message(message).data, visit);
        case Kind::config: return visit_parameters(node_->component()->parameters(), visit);
        case Kind::data: node_->component()->visit_member(node_->member()->name, visit); return;
        case Kind::value:
            if (const auto* value = std::get_if<Value>(&value_)) visit_leaves(*value, visit);
            return;
    }
}

void Channel::visit_latest(const LeafVisitor& given) const {
    if (!is_port() || fresh_ > 0) return visit(fresh_ > 0 ? fresh_ - 1 : 0, given);
    const Value value = node_->port()->value();
    visit_leaves(value, [&](const LeafPath& path, const ValueView& leaf) {
        if (part_.empty() || is_within(path.text(), part_)) given(path, leaf);
    });
}

bool Channel::has_pictures() const { return is_port() && node_->port()->type() == message_of<CameraImage>(); }

void Channel::append_to(Series& series, double seconds) const {
    // A parameter gets one sample at once, not only when it changes.
    const std::size_t messages_now = exists() && holds() && series.size() == 0 ? 1 : fresh_;
    if (messages_now == 0) return;
    std::array<double, Series::most_values> values;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
    const auto of_text = [&](const std::string& text) { return static_cast<double>(series.place_of(text)); };
    const auto is_text = [](const ValueView& leaf) { return leaf.type->kind == Type::Kind::text; };
    for (std::size_t i = 0; i < messages_now; ++i) {
        std::size_t count = 0;
        double at = seconds;
        if (is_port() && part_.empty()) {
            const MessageView message = node_->port()->message(i);
            count = leaf_numbers(message.data, values, of_text);
            at = message.tm;
        } else {
            visit(i, [&](const LeafPath&, const ValueView& leaf) {
                count += leaf_numbers(leaf, std::span(values).subspan(count), of_text);
            });
        }
        if (count > series.labels().size()) {
            std::vector<std::string> labels;
            std::vector<bool> are_texts;
            visit(i, [&](const LeafPath& path, const ValueView& leaf) {
                if (labels.size() == values.size()) return;
                labels.push_back(path.text());
                are_texts.push_back(is_text(leaf));
            });
            series.set_labels(std::move(labels), std::move(are_texts));
        }
        series.add(at, {values.data(), count});
    }
}

}  // namespace nezumi
