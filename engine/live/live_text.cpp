// Writes a port as one line, and a component as a few lines.
#include "engine/live/live_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/names.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

// "-> controller.in, plotter.in" or "not connected".
std::string peers_text(const System& system, const Component& component, const Port& port) {
    constexpr std::size_t most = 4;
    const std::vector<std::string> peers = system.peers(component, port);
    if (peers.empty()) return "not connected";
    const std::size_t count = std::min(most, peers.size());
    std::string text = fmt::format("{} {}", port.direction() == Direction::in ? "<-" : "->",
                                   fmt::join(peers.begin(), peers.begin() + static_cast<std::ptrdiff_t>(count), ", "));
    if (peers.size() > count) text += fmt::format(" and {} more", peers.size() - count);
    return text;
}

// "  held by console"
std::string override_text(const System& system, const Component& component, const Port& port) {
    if (port.override() == Override::none) return "";
    const Actor* holder = system.holder(component.name() + "." + port.name());
    return fmt::format("  {}{}", to_text(port.override()), holder != nullptr ? " by " + to_text(*holder) : "");
}

std::string age_text(double age) { return std::isinf(age) ? "nothing yet" : fmt::format("{:.6g} s old", age); }

std::string bounds_text(const ParameterSpec& spec) {
    if (!spec.choices.empty()) {
        std::string text = "one of";
        for (const Value& choice : spec.choices) text += " " + lua_text(choice);
        return text;
    }
    if (spec.min && spec.max) return fmt::format("{:.6g} to {:.6g}", *spec.min, *spec.max);
    if (spec.min) return fmt::format("at least {:.6g}", *spec.min);
    if (spec.max) return fmt::format("at most {:.6g}", *spec.max);
    return "";
}

// Only the first line, because a message of several lines would break a list.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// "  (limited to 0.3 m/s and 2 rad/s)"; "" if the port has no note.
std::string note_text(const Port& port) {
    return port.note().empty() ? "" : fmt::format("  ({})", first_line(port.note()));
}

// A value of a script, shown like the value of a port: "0.25", "{ left = 1, right = 2 }". The table contains no other
// tables.
std::string plain_text(const PlainData& data, const Value& value, std::size_t width) {
    const auto* table = value.get_if<TableRef>();
    if (table == nullptr) return short_text(value, width);
    std::string text;
    std::int64_t next = 1;
    for (const auto& [key, entry] : data.tables[table->index]) {
        text += text.empty() ? " " : ", ";
        if (text.size() >= width) return "{" + text + "... }";
        const auto* place = key.get_if<std::int64_t>();
        const auto* name = key.get_if<std::string>();
        if (place == nullptr || *place != next++) {
            text += name != nullptr && is_identifier(*name) ? *name : "[" + plain_text(data, key, width) + "]";
            text += " = ";
        }
        text += plain_text(data, entry, width);
    }
    return text.empty() ? "{}" : "{" + text + " }";
}

std::string probe_text(const PlainData& probe) { return plain_text(probe, probe.values.front(), 80); }

}  // namespace

std::string port_text(const System& system, const Component& component, const Port& port) {
    return fmt::format("{}.{}  {}  {}  {}  {}{}{}", component.name(), port.name(), port.type_name(),
                       short_text(port.value()), age_text(port_age(system, port)), peers_text(system, component, port),
                       override_text(system, component, port), note_text(port));
}

std::string component_title(const Component& component) {
    std::string text = fmt::format("{}, {}", component.type(), to_text(component.state()));
    if (component.script_file() != nullptr) text += fmt::format(", version {}", component.version());
    if (component.rate > 0) text += fmt::format(", {:.6g} Hz", component.rate);
    if (!component.set_in_use().empty()) text += fmt::format(", set {}", component.set_in_use());
    return text;
}

std::string component_text(const System& system, const Component& component) {
    std::string text = fmt::format("{}  {}", component.name(), component_title(component));
    if (component.state() == LifeState::error) text += "\n  " + first_line(describe(component.last_error()));
    text += about_text(component);
    std::size_t name_width = 0;
    std::size_t type_width = 0;
    const std::vector<const Port*> ports = ports_of(component);
    for (const Port* port : ports) {
        name_width = std::max(name_width, port->name().size());
        type_width = std::max(type_width, port->type_name().size());
    }
    for (const Port* port : ports) {
        text += fmt::format("\n  {:3} {:{}}  {:{}}  {}{}", port->direction() == Direction::in ? "in" : "out",
                            port->name(), name_width, port->type_name(), type_width,
                            peers_text(system, component, *port), override_text(system, component, *port));
        if (port->override() == Override::held || port->override() == Override::frozen)
            text += " at " + short_text(port->override_value(), 60);
        text += note_text(*port);
    }
    for (const auto& parameter : component.parameters().all())
        text += fmt::format("\n  config.{} = {}", parameter.spec.name, lua_text(parameter.value));
    for (const CommandDeclaration& command : component.commands())
        text += fmt::format("\n  :{}(...)  {}", command.name, first_line(command.doc));
    for (const TaskStatus& task : component.tasks()) {
        text += fmt::format("\n  task {}  {}", task.name, task.status);
        if (!task.waiting.empty()) text += fmt::format(": {} (line {})", task.waiting, task.line);
    }
    for (const Probe& probe : component.probes())
        text += fmt::format("\n  probe {} = {}", probe.name, probe_text(probe.value));
    return text;
}

std::string about_text(const Component& component) {
    const ComponentAbout about = component.about();
    std::string text;
    const auto add = [&text](std::string_view name, const std::string& value) {
        if (!value.empty()) text += fmt::format("{} {} {}", text.empty() ? "\n  about" : ",", name, first_line(value));
    };
    add("version", about.version);
    add("vendor", about.vendor);
    add("category", about.category);
    return text;
}

std::string parameter_text(const Parameters::Parameter& parameter) {
    const ParameterSpec& spec = parameter.spec;
    std::string text = fmt::format("{} = {}", spec.name, lua_text(parameter.value));
    const std::string bounds = bounds_text(spec);
    if (!spec.unit.empty() || !bounds.empty())
        text += fmt::format("  {}{}{}", spec.unit, spec.unit.empty() || bounds.empty() ? "" : ", ", bounds);
    if (!spec.doc.empty()) text += "  " + first_line(spec.doc);
    return text;
}

std::string config_text(const Component& component) {
    std::string text;
    for (const auto& parameter : component.parameters().all()) {
        if (!text.empty()) text += "\n";
        text += parameter_text(parameter);
    }
    return text.empty() ? component.name() + " has no parameters" : text;
}

std::string node_text(const TreeNode& node) {
    using Kind = TreeNode::Kind;
    switch (node.kind()) {
        case Kind::system: return fmt::format("system of {}", fmt::join(node.children(), ", "));
        case Kind::component: return component_text(node.system(), *node.component());
        case Kind::port: return port_text(node.system(), *node.component(), *node.port());
        case Kind::config: return config_text(*node.component());
        case Kind::ports: {
            std::vector<std::string> lines;
            for (const std::string& name : node.children()) lines.push_back(node_text(*node.child(name)));
            return lines.empty() ? node.component()->name() + " has no ports"
                                 : fmt::format("{}", fmt::join(lines, "\n"));
        }
        default: break;
    }
    const auto value = node.value();
    const auto* held = value ? std::get_if<Value>(&*value) : nullptr;
    if (held == nullptr) return value ? "nil" : value.error().message;
    if (node.kind() != Kind::truth) return short_text(*held);
    std::string text;
    for (const Type::Field& field : held->type().fields)
        text +=
            fmt::format("{}{} = {}", text.empty() ? "" : "\n", field.name, short_text(ValueView(*held).field(field)));
    return text;
}

}  // namespace nezumi
