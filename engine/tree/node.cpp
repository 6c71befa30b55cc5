// Defines the children of each kind of tree node; everything else is derived from them.
#include "engine/tree/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "engine/base/names.hpp"
#include "engine/system/act.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

using Names = std::vector<std::string>;
using Kind = TreeNode::Kind;

Names sorted(Names names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::string hint(std::string_view name, const Names& known) { return did_you_mean(name, {known.begin(), known.end()}); }

const Type::Field* find_field(const Type& type, std::string_view name) {
    const auto found = std::find_if(type.fields.begin(), type.fields.end(),
                                    [&](const Type::Field& field) { return field.name == name; });
    return found != type.fields.end() ? &*found : nullptr;
}

// The position in a list for "[2]", from 1; 0 for any other text.
std::size_t place_of(std::string_view step) {
    std::size_t place = 0;
    if (step.starts_with('[') && step.ends_with(']'))
        std::from_chars(step.data() + 1, step.data() + step.size(), place);
    return place;
}

bool is_list(const Type& type) { return type.kind == Type::Kind::sequence || type.kind == Type::Kind::array; }

// The type of a field or an element; nullptr if there is none with this name.
const Type* type_below(const Type& type, std::string_view step) {
    if (is_list(type)) return place_of(step) > 0 ? type.element : nullptr;
    const Type::Field* field = find_field(type, step);
    return field != nullptr ? field->type : nullptr;
}

std::optional<Value> value_below(ValueView value, std::string_view part) {
    while (!part.empty() && !is_list(*value.type)) {
        const Type::Field* field = find_field(*value.type, take_step(part));
        if (field == nullptr) return std::nullopt;
        value = value.field(*field);
    }
    if (part.empty()) return Value(value);
    const std::size_t place = place_of(take_step(part));
    if (place == 0 || place > value.count()) return std::nullopt;
    return with_element(value, place - 1, [&](const ValueView& element) { return value_below(element, part); });
}

Names port_names(const Component& component) {
    Names names;
    for (const Port* port : ports_of(component)) names.push_back(port->name());
    return names;
}

}  // namespace

std::vector<const Port*> ports_of(const Component& component) {
    std::vector<const Port*> ports;
    for (const InPortBase* port : component.in_ports()) ports.push_back(port);
    for (const OutPortBase* port : component.out_ports()) ports.push_back(port);
    return ports;
}

std::string join_path(std::string whole, std::string_view part) {
    if (!whole.empty() && !part.empty() && part.front() != '[') whole += '.';
    return whole.append(part);
}

std::string_view take_step(std::string_view& path) {
    const bool is_element = path.starts_with('[');
    const auto ends = [](char each) { return each == '.' || each == ':' || each == '['; };
    const std::size_t end = is_element
                                ? path.find(']')
                                : static_cast<std::size_t>(std::find_if(path.begin(), path.end(), ends) - path.begin());
    const std::string_view step = path.substr(0, is_element && end != std::string_view::npos ? end + 1 : end);
    path.remove_prefix(step.size());
    if (path.starts_with('.') || path.starts_with(':')) path.remove_prefix(1);
    return step;
}

Kind TreeNode::kind() const {
    if (component_ == nullptr) return Kind::system;
    if (command_ != nullptr) return Kind::command;
    if (member_ != nullptr && member_->called) return Kind::method;
    if (parameter_ != nullptr) return part_.empty() ? Kind::parameter : Kind::value;
    if (member_ != nullptr) return part_.empty() || member_->kind == Kind::data ? member_->kind : Kind::value;
    if (port_ != nullptr) return part_.empty() ? Kind::port : Kind::value;
    return Kind::component;
}

bool TreeNode::is_of_value() const { return port_ != nullptr && (member_ == nullptr || member_->name == "value"); }

std::string TreeNode::whole() const {
    std::string path = component_ != nullptr ? component_->name() : "";
    if (port_ != nullptr) path = join_path(std::move(path), port_->name());
    if (command_ != nullptr) path = join_path(std::move(path), command_->name);
    if (member_ != nullptr && !is_of_value()) path = join_path(std::move(path), member_->name);
    return path;
}

std::string TreeNode::part() const { return parameter_ != nullptr ? join_path(parameter_->spec.name, part_) : part_; }

// The field of the last step of the part.
const Type::Field* TreeNode::field() const {
    const Type* type = whole_type();
    const Type::Field* field = nullptr;
    for (std::string_view rest = part_; type != nullptr && !rest.empty();) {
        const std::string_view step = take_step(rest);
        field = find_field(*type, step);
        type = type_below(*type, step);
    }
    return field;
}

std::string_view TreeNode::unit() const {
    if (const Type::Field* own = field()) return own->unit;
    return parameter_ != nullptr ? std::string_view(parameter_->spec.unit) : "";
}

std::string_view TreeNode::doc() const {
    if (const Type::Field* own = field()) return own->doc;
    if (!part_.empty()) return "";
    if (parameter_ != nullptr) return parameter_->spec.doc;
    if (command_ != nullptr) return command_->doc;
    if (member_ != nullptr) return member_->doc;
    return port_ != nullptr ? std::string_view(port_->doc()) : "";
}

const Type* TreeNode::whole_type() const {
    if (parameter_ != nullptr) return &parameter_->value.type();
    if (is_of_value()) return port_->type()->payload;
    if (member_ != nullptr && member_->kind == Kind::truth) return &type_of<Truth>();
    if (member_ == nullptr || member_->kind != Kind::value || member_->value == nullptr) return nullptr;
    const auto value = member_->value(*this, {});
    const auto* held = value ? std::get_if<Value>(&*value) : nullptr;
    return held != nullptr ? &held->type() : nullptr;
}

const Type* TreeNode::type() const { return part_.empty() ? whole_type() : part_type_; }

Expected<TreeNode> TreeNode::child(std::string_view name) const {
    TreeNode made = *this;
    switch (kind()) {
        case Kind::system: {
            const auto component = system_->component(name);
            if (!component) return Unexpected(component.error());
            made.component_ = *component;
            return made;
        }
        case Kind::component: return child_of_component(name);
        case Kind::port: return child_of_port(name);
        case Kind::ports:
            made.member_ = nullptr;
            made.port_ = component_->find_port(name);
            if (made.port_ != nullptr) return made;
            return failure(
                fmt::format("{} has no port '{}'{}", component_->name(), shown(name), hint(name, children())));
        case Kind::config:
            made.parameter_ = component_->parameters().find(name);
            if (made.parameter_ != nullptr) return made;
            return failure(
                fmt::format("{}: unknown parameter '{}'{}", component_->name(), shown(name), hint(name, children())));
        default: return below(name);
    }
}

// Lookup order: members whose names ports can't have, ports, commands, then members that yield to ports.
Expected<TreeNode> TreeNode::child_of_component(std::string_view name) const {
    TreeNode made = *this;
    const MemberInfo* own = find_member(component_members(), name);
    if (own != nullptr && own->robot && robot() == nullptr) own = nullptr;
    if (own == nullptr || own->yields) {
        made.port_ = component_->find_port(name);
        if (made.port_ != nullptr) return made;
        for (const CommandDeclaration& command : component_->commands()) {
            if (command.name != name) continue;
            made.command_ = &command;
            return made;
        }
    }
    made.member_ = own;
    if (own != nullptr) return made;
    const std::string& owner = component_->name();
    if (component_->parameters().find(name) != nullptr)
        return failure(
            fmt::format("{} has no '{}': its parameter is {}.config.{}", owner, shown(name), owner, shown(name)));
    return failure(fmt::format("{} has no '{}'{}", owner, shown(name), hint(name, children())));
}

Expected<TreeNode> TreeNode::child_of_port(std::string_view name) const {
    TreeNode made = *this;
    made.member_ = find_member(port_members(), name);
    if (made.member_ != nullptr) return made;
    const std::string path = whole();
    if (name == "read") return failure(fmt::format("{}: only its own component can read it; use {}.value", path, path));
    std::string near = hint(name, children());
    if (near.empty()) near = fmt::format("; the value's own fields are {}.value.NAME", path);
    return failure(fmt::format("{} has no '{}'{}", path, shown(name), near));
}

Expected<TreeNode> TreeNode::below(std::string_view name) const {
    TreeNode made = *this;
    made.part_ = join_path(part_, name);
    if (kind() == Kind::data) return made;
    const Type* own = type();
    made.part_type_ = own != nullptr ? type_below(*own, name) : nullptr;
    if (made.part_type_ != nullptr) return made;
    const std::string path = this->path();
    if (own != nullptr && is_list(*own))
        return failure(fmt::format("{} is a list: {}[1] is its first element", path, path));
    if (own == nullptr || own->kind != Type::Kind::structure)
        return failure(fmt::format("{} is a single value: it has no '{}'", path, shown(name)));
    return failure(fmt::format("{} has no '{}'{}", path, shown(name), hint(name, children())));
}

// Lookup order: `value`, then the fields of the port's value, then the port's own members.
Expected<TreeNode> TreeNode::step(std::string_view name) const {
    if (kind() != Kind::port) return child(name);
    TreeNode value = *this;
    value.member_ = find_member(port_members(), "value");
    if (name == "value") return value;
    const Type& type = *value.whole_type();
    if (type_below(type, name) != nullptr) return value.child(name);
    if (find_member(port_members(), name) != nullptr) return child(name);
    if (type.kind != Type::Kind::structure) return value.child(name);
    Names known = value.children();
    for (std::string& each : children()) known.push_back(std::move(each));
    return failure(fmt::format("{} has no '{}'{}", whole(), shown(name), hint(name, known)));
}

Expected<TreeNode> TreeNode::find(std::string_view path) const {
    Expected<TreeNode> node = *this;
    while (node && !path.empty()) node = node->step(take_step(path));
    return node;
}

Names TreeNode::children(Called called) const {
    const bool some = called != Called::yes, all_called = called != Called::no;
    Names names;
    const auto add_members = [&](std::span<const MemberInfo> members) {
        for (const MemberInfo& each : members) {
            if ((each.called ? all_called : some) && (!each.robot || robot() != nullptr)) names.emplace_back(each.name);
        }
    };
    switch (kind()) {
        case Kind::component:
            add_members(component_members());
            if (some) {
                const Names ports = port_names(*component_);
                names.insert(names.end(), ports.begin(), ports.end());
            }
            for (const CommandDeclaration& each : component_->commands()) {
                if (all_called) names.push_back(each.name);
            }
            return sorted(std::move(names));
        case Kind::port: add_members(port_members()); return names;
        default: break;
    }
    if (!some) return names;
    switch (kind()) {
        case Kind::system:
            for (const auto& component : system_->components()) names.push_back(component->name());
            return names;
        case Kind::ports: return port_names(*component_);
        case Kind::config:
            for (const auto& parameter : component_->parameters().all()) names.push_back(parameter.spec.name);
            return names;
        case Kind::data: return data_names();
        default:
            if (const Type* type = this->type(); type != nullptr) {
                for (const Type::Field& field : type->fields) names.push_back(field.name);
            }
            return kind() == Kind::truth ? sorted(std::move(names)) : names;
    }
}

Names TreeNode::data_names() const {
    if (member_->name == "probes" && !part_.empty())
        return part_.find('.') == std::string::npos ? Names{"age", "tm", "value"} : Names{};
    const std::string prefix = part_.empty() ? "" : part_ + ".";
    Names names;
    component_->visit_member(member_->name, [&](const LeafPath& leaf, const ValueView&) {
        const std::string text = leaf.text();
        if (!text.starts_with(prefix)) return;
        const std::string name = text.substr(prefix.size(), text.find_first_of(".[", prefix.size()) - prefix.size());
        if (is_identifier(name)) names.push_back(name);
    });
    return sorted(std::move(names));
}

Expected<NodeValue> TreeNode::value_of(std::string_view part, const PlainLimit& limit) const {
    const auto part_of = [&](const ValueView& whole) {
        auto found = value_below(whole, part);
        return found ? NodeValue{std::move(*found)} : NodeValue{};
    };
    if (parameter_ != nullptr) return part_of(parameter_->value);
    if (is_of_value()) return part_of(port_->value());
    if (member_ == nullptr || member_->value == nullptr) return NodeValue{};
    auto whole = member_->value(*this, limit);
    if (!whole || part.empty()) return whole;
    const auto* held = std::get_if<Value>(&*whole);
    return held != nullptr ? part_of(*held) : NodeValue{};
}

Expected<TreeNode> TreeNode::to_set(std::string_view name) const {
    const std::string path = this->path();
    switch (kind()) {
        case Kind::config: return child(name);
        case Kind::component: break;
        case Kind::port:
            return failure(fmt::format("{}: its members can't be set; write a value with :write(value)", path));
        case Kind::truth: return failure("the truth can't be set: use teleport for the pose, disturb for the velocity");
        default: return failure(fmt::format("{} can't be set", shown(name)));
    }
    const std::string whole = fmt::format("{}.{}", path, shown(name));
    if (component_->find_port(name) != nullptr)
        return failure(fmt::format("{} is a port: write a value with {}:write(value)", whole, whole));
    if (component_->parameters().find(name) != nullptr)
        return failure(fmt::format("{} can't be set: its parameter is {}.config.{}", whole, path, shown(name)));
    return failure(fmt::format("{} can't be set; parameters can, as in {}.config.NAME = value", whole, path));
}

SetParameter TreeNode::set(Value value) const { return {component_->name(), parameter_->spec.name, std::move(value)}; }

}  // namespace nezumi
