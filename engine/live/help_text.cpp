// Shows the documentation from the declaration of each thing.
#include "engine/live/help_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/live/live_text.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

// Indents each line of a text.
std::string indented(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        result += "\n  " + std::string(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

// The text after two spaces; "" for an empty text.
std::string behind(std::string_view text) { return text.empty() ? "" : "  " + std::string(text); }

void add_fields(std::string& text, const Type& type, const std::string& path) {
    for (const Type::Field& field : type.fields) {
        const std::string name = fmt::format("{}.{}", path, field.name);
        if (field.type->kind == Type::Kind::structure) {
            add_fields(text, *field.type, name);
        } else {
            text += fmt::format("\n  {}{}{}", name, behind(field.unit), behind(field.doc));
        }
    }
}

std::string port_help(const TreeNode& node) {
    const Port& port = *node.port();
    const MessageType& message = *port.type();
    std::string text = fmt::format("{}.{}  {} {}: {}", node.component()->name(), port.name(),
                                   port.direction() == Direction::in ? "in" : "out", message.name, message.doc);
    text += indented(port.doc());
    add_fields(text, *message.payload, "value");
    std::vector<std::string_view> members;
    for (const MemberInfo& each : port_members()) members.push_back(each.name);
    return text + fmt::format("\n  members: {}", fmt::join(members, ", "));
}

std::string component_help(const TreeNode& node) {
    const Component& component = *node.component();
    std::string text = fmt::format("{}  {}", component.name(), component_title(component));
    text += indented(component.about().description);
    text += about_text(component);
    for (const Port* port : ports_of(component))
        text += fmt::format("\n  {:3} {}  {}{}", port->direction() == Direction::in ? "in" : "out", port->name(),
                            port->type_name(), behind(first_line(port->doc())));
    for (const auto& parameter : component.parameters().all()) text += "\n  config." + parameter_text(parameter);
    for (const CommandDeclaration& command : component.commands())
        text += fmt::format("\n  :{}(...){}", command.name, behind(first_line(command.doc)));
    return text + fmt::format("\n  help \"{0}.status\" explains a member; the members are {1}", component.name(),
                              fmt::join(node.children(), ", "));
}

std::string parameter_help(const TreeNode& node) {
    const auto& parameter = *node.parameter();
    return fmt::format("{}.config.{}\n  its default is {}, {}", node.component()->name(), parameter_text(parameter),
                       lua_text(parameter.spec.initial), parameter.set ? "and it was set" : "and it was not set");
}

}  // namespace

std::string help_text(const TreeNode& node) {
    if (node.component() == nullptr) return "";
    if (node.parameter() != nullptr) return parameter_help(node);
    if (node.command() != nullptr)
        return fmt::format("{}:{}(...){}", node.component()->name(), node.command()->name, behind(node.doc()));
    const MemberInfo* member = node.member();
    if (member == nullptr) return node.port() != nullptr ? port_help(node) : component_help(node);
    if (node.kind() == TreeNode::Kind::config) return config_text(*node.component());
    if (node.port() != nullptr && member->name == "value") return port_help(node);
    std::string owner = node.component()->name();
    if (node.port() != nullptr) owner = join_path(std::move(owner), node.port()->name());
    return fmt::format("{}{}{}{}  {}", owner, member->called ? ":" : ".", member->name, member->usage, member->doc);
}

}  // namespace nezumi
