// From ports to lines to wheels.
#include "bindings/lua/live/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "bindings/lua/live/live_text.hpp"
#include "bindings/lua/sandbox/lexer.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/robot/robot.hpp"

namespace nezumi {
namespace {

Explanation::PortValue look_at(const System& system, const Component& component, const Port& port) {
    Explanation::PortValue seen{.port = component.name() + "." + port.name(), .value = ""};
    if (port.count() > 0) seen.value = payload_text(port.value());
    seen.override = to_text(port.override());
    for (const ConnectionSpec& connection : system.connections()) {
        if (connection.from == seen.port) seen.peers.push_back(connection.to);
        if (connection.to == seen.port) seen.peers.push_back(connection.from);
    }
    return seen;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

// Those that the line names, `config.speed` and such too.
std::vector<LineTrace::Value> named_in(std::string_view text, const std::vector<LineTrace::Value>& values) {
    std::vector<LineTrace::Value> named;
    Lexer lexer(text);
    std::string path;  // "config" or "config.speed", as far as it has come
    bool is_field = false;
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) {
        if (token.is(".") && !path.empty()) {
            is_field = true;
            continue;
        }
        const bool is_name = token.kind == Token::Kind::name;
        if (!is_name) {
            path = token.is(":") || token.is(".") ? "?" : "";  // what follows is no variable
            is_field = path == "?";
            continue;
        }
        if (is_field) {
            path += '.';
        } else {
            path.clear();
        }
        path += token.text;
        is_field = false;
        const auto is_it = [&](const LineTrace::Value& each) { return each.name == path; };
        const auto value = std::find_if(values.begin(), values.end(), is_it);
        if (value != values.end() && std::none_of(named.begin(), named.end(), is_it)) named.push_back(*value);
    }
    return named;
}

void add_robot(Explanation& explanation, const System& system, std::string_view port) {
    const auto* robot = dynamic_cast<const Robot*>(system.find(port.substr(0, port.find('.'))));
    if (robot == nullptr) return;
    for (const Explanation::OfRobot& each : explanation.robots) {
        if (each.robot == robot->name()) return;
    }
    const VelocityGuard& guard = robot->guard();
    Explanation::OfRobot seen{.robot = robot->name(),
                              .asked = guard.target(),
                              .limited = guard.current(),
                              .speed = guard.limits().speed,
                              .yaw_rate = guard.limits().yaw_rate};
    if (robot->told()) {
        seen.wheels_told = true;
        seen.wheels = *robot->told();
    }
    explanation.robots.push_back(seen);
}

std::string text_of(const Explanation::PortValue& port, std::string_view arrow) {
    std::string text = port.port;
    if (!port.peers.empty()) text += fmt::format(" {} {}", arrow, fmt::join(port.peers, ", "));
    text += ": " + (port.value.empty() ? "nothing yet" : port.value);
    if (!port.override.empty()) text += ", " + port.override;
    return text;
}

}  // namespace

Explanation explain(const System& system, const ScriptComponent& component) {
    const LineTrace::Seen& seen = component.latest_trace();
    Explanation explanation{.component = component.name(),
                            .tick = component.now().tick,
                            .seconds = component.now().seconds,
                            .is_cut = seen.is_cut};
    for (const auto& port : component.in_ports()) explanation.inputs.push_back(look_at(system, component, *port));
    for (const auto& port : component.out_ports()) explanation.outputs.push_back(look_at(system, component, *port));

    std::map<std::string, std::string> texts;
    std::map<std::string, std::vector<std::string_view>> lines;
    for (const LineTrace::Line& line : seen.lines) {
        if (!texts.contains(line.file)) {
            const std::string& text = texts[line.file] = component.script().text_of(line.file);
            lines[line.file] = lines_of(text);
        }
        const auto& all = lines[line.file];
        const auto index = static_cast<std::size_t>(line.line - 1);
        const std::string_view text = index < all.size() ? all[index] : std::string_view();
        explanation.lines.push_back({.file = line.file,
                                     .line = line.line,
                                     .depth = line.depth,
                                     .text = std::string(trimmed(text)),
                                     .values = text.empty() ? line.values : named_in(text, line.values)});
    }
    for (const auto* ports : {&explanation.inputs, &explanation.outputs}) {
        for (const Explanation::PortValue& port : *ports) {
            for (const std::string& peer : port.peers) add_robot(explanation, system, peer);
        }
    }
    return explanation;
}

std::string to_text(const Explanation& explanation) {
    std::string text =
        fmt::format("{} at {:.2f} s, tick {}", explanation.component, explanation.seconds, explanation.tick);
    for (const auto& port : explanation.inputs) text += "\n  " + text_of(port, "<-");
    for (const Explanation::Line& line : explanation.lines) {
        text += fmt::format("\n  {}:{}  {}", line.file, line.line, line.text);
        for (const LineTrace::Value& value : line.values) text += fmt::format("   {} = {}", value.name, value.text);
    }
    if (explanation.is_cut) text += "\n  ... and more lines";
    for (const auto& port : explanation.outputs) text += "\n  " + text_of(port, "->");
    for (const auto& robot : explanation.robots) {
        text += fmt::format(
            "\n  {} was told vx = {:g} m/s, va = {:g} rad/s; within its limits ({:g} m/s, {:g} rad/s) now vx = {:g}, "
            "va "
            "= {:g}",
            robot.robot, robot.asked.vx, robot.asked.va, robot.speed, robot.yaw_rate, robot.limited.vx,
            robot.limited.va);
        text += robot.wheels_told ? fmt::format("\n  {}'s wheels: left {:g} m/s, right {:g} m/s", robot.robot,
                                                robot.wheels.left, robot.wheels.right)
                                  : fmt::format("\n  {}'s wheels roll freely", robot.robot);
    }
    return text;
}

}  // namespace nezumi
