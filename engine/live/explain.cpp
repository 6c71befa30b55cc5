// Collects the values of ports, the executed lines, and the commands of wheels.
#include "engine/live/explain.hpp"

#include <fmt/format.h>

#include <string_view>

#include "engine/robot/robot.hpp"
#include "engine/tree/member.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

Explanation::PortValue look_at(const System& system, const Component& component, const Port& port) {
    Explanation::PortValue seen{.port = component.name() + "." + port.name(), .value = ""};
    if (port.count() > 0) seen.value = short_text(port.value());
    seen.override = to_text(port.override());
    for (const ConnectionSpec& connection : system.connections()) {
        if (connection.from == seen.port) seen.peers.push_back(connection.to);
        if (connection.to == seen.port) seen.peers.push_back(connection.from);
    }
    return seen;
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

void add_results(const Explanation& explanation, std::string& text) {
    for (const auto& port : explanation.outputs) text += "\n  " + text_of(port, "->");
    for (const auto& robot : explanation.robots) {
        text += fmt::format(
            "\n  {} was commanded vx = {:g} m/s, va = {:g} rad/s; within its limits ({:g} m/s, {:g} rad/s) it now has "
            "vx = {:g}, va = {:g}",
            robot.robot, robot.asked.vx, robot.asked.va, robot.speed, robot.yaw_rate, robot.limited.vx,
            robot.limited.va);
        text += robot.wheels_told ? fmt::format("\n  {}'s wheels: left {:g} m/s, right {:g} m/s", robot.robot,
                                                robot.wheels.left, robot.wheels.right)
                                  : fmt::format("\n  {}'s wheels roll freely", robot.robot);
    }
}

}  // namespace

Explanation explain(const System& system, const Component& component) {
    Explanation explanation{.component = component.name(),
                            .tick = component.now().tick,
                            .seconds = component.now().seconds,
                            .traced = component.latest_trace()};
    for (const auto& port : component.in_ports()) explanation.inputs.push_back(look_at(system, component, *port));
    for (const auto& port : component.out_ports()) explanation.outputs.push_back(look_at(system, component, *port));

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
    add_results(explanation, text);
    for (const auto& port : explanation.inputs) text += "\n  " + text_of(port, "<-");
    for (const TracedLines::Line& line : explanation.traced.lines) {
        if (line.turns_left_out > 0) text += fmt::format("\n  ... {} more turns of the loop", line.turns_left_out);
        text += fmt::format("\n  {}:{}  {}", line.file, line.line, line.text);
        for (const TracedLines::Value& value : line.values) text += fmt::format("   {} = {}", value.name, value.text);
    }
    if (explanation.traced.is_cut) text += "\n  ... and more lines";
    return text;
}

}  // namespace nezumi
