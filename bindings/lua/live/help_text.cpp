// Says what each thing was described as where it was declared.
#include "bindings/lua/live/help_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bindings/lua/live/objects.hpp"
#include "bindings/lua/values/member_names.hpp"
#include "engine/base/names.hpp"
#include "engine/live/live_text.hpp"
#include "engine/robot/robot.hpp"
#include "engine/trace/channel.hpp"

namespace nezumi {
namespace {

// A text of several lines, each moved to the right.
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

// "  text", or nothing.
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

std::string port_help(const Component& component, const Port& port) {
    const MessageInfo& message = message_infos()[port.type()];
    std::string text = fmt::format("{}.{}  {} {}: {}", component.name(), port.name(),
                                   port.direction() == Direction::in ? "in" : "out", message.name, message.doc);
    text += indented(port.doc());
    add_fields(text, *message.payload, "value");
    return text + fmt::format("\n  it has {}", fmt::join(Objects::port_members(), ", "));
}

std::string component_help(const Component& component) {
    std::string text = fmt::format("{}  {}", component.name(), component_title(component));
    text += indented(component.about().description);
    text += about_text(component);
    const auto add_port = [&](const Port& port) {
        text += fmt::format("\n  {:3} {}  {}{}", port.direction() == Direction::in ? "in" : "out", port.name(),
                            port.type_name(), behind(first_line(port.doc())));
    };
    for (const auto& port : component.in_ports()) add_port(*port);
    for (const auto& port : component.out_ports()) add_port(*port);
    for (const auto& parameter : component.parameters().all()) text += "\n  config." + parameter_text(parameter);
    for (const CommandDeclaration& command : component.commands())
        text += fmt::format("\n  :{}(...){}", command.name, behind(first_line(command.doc)));
    return text + fmt::format("\n  help \"{0}.status\" explains a member; they are {1}", component.name(),
                              fmt::join(Objects::members(component), ", "));
}

std::string member_help(const Component& component, const MemberName& member) {
    return fmt::format("{}{}{}{}  {}", component.name(), member.called ? ":" : ".", member.name, member.usage,
                       member.doc);
}

template <class Names>
Error unknown(const Component& component, std::string_view what, std::string_view name, const Names& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    return {fmt::format("{} has no {}'{}'{}", component.name(), what, shown(name), did_you_mean(name, names)), {}};
}

Expected<std::string> parameter_help(const Component& component, std::string_view name) {
    const auto* parameter = component.parameters().find(name);
    if (parameter != nullptr) {
        return fmt::format("{}.config.{}\n  its default is {}, {}", component.name(), parameter_text(*parameter),
                           to_text(parameter->spec.initial),
                           parameter->set ? "and it was set" : "and it was not set");
    }
    std::vector<std::string> names;
    for (const auto& each : component.parameters().all()) names.push_back(each.spec.name);
    return Unexpected(unknown(component, "parameter ", name, names));
}

// What `X.name` is, in the order in which `X.name` looks for it.
Expected<std::string> named_help(const Component& component, std::string_view name) {
    const auto all = member_names();
    const bool is_robot = dynamic_cast<const Robot*>(&component) != nullptr;
    const auto own = std::find_if(
        all.begin(), all.end(), [&](const MemberName& each) { return each.name == name && (!each.robot || is_robot); });
    if (own != all.end() && !own->yields) return member_help(component, *own);
    if (const Port* port = component.find_port(name)) return port_help(component, *port);
    for (const CommandDeclaration& command : component.commands()) {
        if (command.name == name)
            return fmt::format("{}:{}(...){}", component.name(), command.name, behind(command.doc));
    }
    if (own != all.end()) return member_help(component, *own);
    return Unexpected(unknown(component, "", name, Objects::members(component)));
}

// Whether `X.member` has what is asked for below it: in the truth and in a port.
Expected<void> check_below(const System& system, const Component& component, std::string_view member,
                           std::string_view below) {
    if (below.empty() || (member != "truth" && component.find_port(member) == nullptr)) return {};
    std::string followed = fmt::format("{}.{}", component.name(), member);
    if (member != "truth") {
        const std::string_view of_port = below.substr(0, below.find_first_of(".["));
        const auto members = Objects::port_members();
        const std::vector<std::string_view> names(members.begin(), members.end());
        if (std::find(names.begin(), names.end(), of_port) == names.end())
            return failure(fmt::format("{} has no '{}'{}", followed, shown(of_port), did_you_mean(of_port, names)));
        if (of_port != "value") return {};
        below.remove_prefix(std::min(of_port.size() + 1, below.size()));
    }
    if (!below.empty()) followed += fmt::format(".{}", below);
    const auto channel = Channel::find(system, followed);
    return channel ? Expected<void>() : Unexpected(channel.error());
}

}  // namespace

Expected<std::string> help_text(const System& system, std::string_view path) {
    const std::size_t end = std::min(path.find_first_of(".:"), path.size());
    const auto component = system.component(path.substr(0, end));
    if (!component) return Unexpected(component.error());
    if (end == path.size()) return component_help(**component);
    const std::string_view rest = path.substr(end + 1);
    const std::string_view member = rest.substr(0, rest.find('.'));
    const std::string_view below = member.size() < rest.size() ? rest.substr(member.size() + 1) : "";
    if (member == "config") return below.empty() ? config_text(**component) : parameter_help(**component, below);
    if (member == "ports" && !below.empty()) {
        const std::string_view name = below.substr(0, below.find('.'));
        if (const Port* port = (*component)->find_port(name)) return port_help(**component, *port);
        return Unexpected(unknown(**component, "port ", name, Objects::members(**component)));
    }
    if (auto ok = check_below(system, **component, member, below); !ok) return Unexpected(ok.error());
    return named_help(**component, member);
}

}  // namespace nezumi
