// The table of all members of components.
#include <algorithm>
#include <cmath>

#include "engine/ports/setting.hpp"
#include "engine/system/act_fields.hpp"
#include "engine/tree/read_member.hpp"
#include "engine/world/robot_fields.hpp"

namespace nezumi {
namespace {

using namespace reads;

constexpr double dust = 1e-9;  // [m], [rad], [m/s], [rad/s]; smaller values are rounding errors

// Reads the script's `state` within the limit.
Read of_state(const TreeNode& node, const PlainLimit& limit) {
    auto state = node.component()->state_snapshot(limit);
    return state ? Read(std::move(*state)) : Unexpected(state.error());
}

NodeValue whole_of(PlainData data) {
    const std::size_t whole = data.tables.size();
    return PlainSnapshot{std::move(data), whole};
}

NodeValue failure_of(const Component& component) {
    if (component.state() != LifeState::error) return {};
    const Error& error = component.last_error();
    PlainData data = PlainData::empty_table();
    const Value frames = error.frames ? add_frames(*error.frames, data) : Value();
    PlainData::Table& fields = data.tables.front();
    if (!error.place.file.empty()) fields.push_back({"file", error.place.file});
    if (error.frames) fields.push_back({"frames", frames});
    if (error.place.line > 0) fields.push_back({"line", std::int64_t{error.place.line}});
    fields.push_back({"text", error.message});
    fields.push_back({"tm", component.failed_at()});
    return whole_of(std::move(data));
}

Read battery_of(const TreeNode& node, const PlainLimit& /*limit*/) {
    const Robot& robot = *node.robot();
    const auto volts = robot.battery();
    if (!volts) return failure(robot.name() + ": its battery is known only with a real robot that measures it");
    return Value{*volts};
}

std::vector<std::string> names_of(std::span<const CommandDeclaration> commands) {
    std::vector<std::string> names;
    for (const CommandDeclaration& command : commands) names.push_back(command.name);
    return names;
}

const std::vector<MemberInfo>& all_members() {
    static const std::vector<MemberInfo> members{
        {.name = "activate",
         .type = "fun(self: Component): string",
         .called = true,
         .usage = "()",
         .doc = "makes the component ACTIVE; returns the new status"},
        {.name = "battery",
         .type = "number",
         .robot = true,
         .yields = true,
         .doc = "battery voltage [V], NaN while unknown: only of real robots that measure it",
         .value = battery_of},
        {.name = "buzzer",
         .type = "integer",
         .robot = true,
         .yields = true,
         .doc = "tone of the robot's buzzer [Hz], 0 for silence",
         .value = of_robot<[](const Robot& robot) { return std::int64_t{robot.buzzer_hertz()}; }>},
        {.name = "collided",
         .type = "boolean",
         .robot = true,
         .doc = "whether the robot touches something",
         .value = of_seen<[](const SeenRobot& seen) { return seen.world->collided(seen.id); }>},
        {.name = "commands",
         .type = "string[]",
         .yields = true,
         .doc = "the names of the component's commands",
         .instead = "its script declares them",
         .value = of_component<[](const Component& component) { return names_of(component.commands()); }>},
        {.name = "config",
         .type = "table<string, ParameterValue>",
         .doc = "the component's parameters; values must be within their bounds",
         .kind = TreeNode::Kind::config},
        {.name = "deactivate",
         .type = "fun(self: Component): string",
         .called = true,
         .usage = "()",
         .doc = "makes the component INACTIVE; returns the new status"},
        {.name = "disturb",
         .type = "fun(self: Component, velocities?: VelocityConstraintFields)",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 1,
         .usage = " " + usage_of<VelocityConstraint>(Describe<VelocityConstraint>::at_once),
         .doc = "forces these velocities on the robot; without velocities it moves freely again"},
        {.name = "error",
         .type = "string?",
         .yields = true,
         .doc = "in ERROR: the error; otherwise nil",
         .value = of_component<[](const Component& component) {
             return text_if_any(component.state() == LifeState::error ? describe(component.last_error()) : "");
         }>},
        {.name = "failure",
         .type = "{ text: string, tm: number, file?: string, line?: integer, frames?: { file: string, line: integer, "
                 "name?: string, locals: table }[] }?",
         .yields = true,
         .doc =
             "in ERROR: the error, its time [s], its line, and the functions that were running, the innermost first, "
             "each with file, line, name and locals; otherwise nil",
         .instead = "its script fails",
         .value = of_component<failure_of>},
        {.name = "leds",
         .type = "boolean[]",
         .robot = true,
         .yields = true,
         .doc = "which of the robot's lights are on",
         .instead = "write the port that switches them",
         .value = of_robot<[](const Robot& robot) { return robot.leds(); }>},
        {.name = "limits",
         .type = "table<string, number>",
         .robot = true,
         .yields = true,
         .doc = "the robot's limits of speed and acceleration",
         .instead = "set them in the system file",
         .value = of_robot<[](const Robot& robot) {
             return Value(ValueView(record_of<Limits>(), &robot.guard().limits()));
         }>},
        {.name = "name",
         .type = "string",
         .doc = "the component's name",
         .value = of_component<[](const Component& component) { return component.name(); }>},
        {.name = "ports",
         .type = "table<string, Port>",
         .doc = "the component's ports by name",
         .kind = TreeNode::Kind::ports},
        {.name = "press",
         .type = "fun(self: Component, sensor: string, pressed?: boolean)",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 2,
         .usage = "(sensor, pressed)",
         .doc = "presses a button or touch sensor; with false releases it"},
        {.name = "probes",
         .type = "table<string, ProbeView>",
         .doc = "the values of `probe` calls in the script: value, tm and age",
         .instead = "its script shows them",
         .kind = TreeNode::Kind::data,
         .value = of_node<[](const TreeNode& node) {
             return whole_of(describe(node.component()->probes(), node.system().now().seconds));
         }>},
        {.name = "rate",
         .type = "number",
         .yields = true,
         .doc = "executions per second [Hz]",
         .value = of_node<[](const TreeNode& node) {
             const double rate = node.component()->rate;
             return rate == 0 ? node.system().settings().rate : rate;
         }>},
        {.name = "reset",
         .type = "fun(self: Component): string",
         .called = true,
         .usage = "()",
         .doc = "takes the component out of ERROR; returns the new status"},
        {.name = "said",
         .type = "string[]",
         .robot = true,
         .yields = true,
         .doc = "the last 100 texts sent to the robot's speaker",
         .instead = "send texts to the port of its speaker",
         .value = of_robot<[](const Robot& robot) {
             return std::vector<std::string>(robot.said().begin(), robot.said().end());
         }>},
        {.name = "set",
         .type = "string?",
         .yields = true,
         .doc = "the named set of parameters in use, or nil",
         .value = of_component<[](const Component& component) { return text_if_any(component.set_in_use()); }>},
        {.name = "sets",
         .type = "string[]",
         .doc = "the names of the component's parameter sets",
         .instead = "set them in the system file",
         .value = of_component<[](const Component& component) {
             std::vector<std::string> names;
             for (const auto& [name, values] : component.sets) names.push_back(name);
             return names;
         }>},
        {.name = "state",
         .type = "table",
         .doc = "a copy of the script's `state`",
         .instead = "a command of its script can change it",
         .kind = TreeNode::Kind::data,
         .value = of_state},
        {.name = "status",
         .type = R"("INACTIVE"|"ACTIVE"|"ERROR")",
         .doc = "\"INACTIVE\", \"ACTIVE\" or \"ERROR\"",
         .value = of_component<[](const Component& component) { return std::string(to_text(component.state())); }>},
        {.name = "tasks",
         .type = "table<string, TaskView>",
         .doc = "the component's tasks: status, since, waiting and line of each",
         .instead = "its script declares them",
         .kind = TreeNode::Kind::data,
         .value = of_component<[](const Component& component) { return whole_of(describe(component.tasks())); }>},
        {.name = "teleport",
         .type = "fun(self: Component, pose: PoseFields)",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 1,
         .usage = "(pose)",
         .doc = "moves the robot to a pose, at rest"},
        {.name = "touching",
         .type = "string?",
         .robot = true,
         .yields = true,
         .doc = "what the robot touches, or nil",
         .value = of_seen<[](const SeenRobot& seen) { return text_if_any(seen.world->collided_with(seen.id)); }>},
        {.name = "truth",
         .type = "{ pose: Pose2D, velocity: Velocity2D, height: number, tilt: number }",
         .robot = true,
         .doc = "the robot's true state in simulation: pose, velocity, height, tilt",
         .kind = TreeNode::Kind::truth,
         .value = of_seen<[](const SeenRobot& seen) { return seen_truth(*seen.world, seen.id); }>},
        {.name = "type",
         .type = "string",
         .doc = "the component's type",
         .value = of_component<[](const Component& component) { return component.type(); }>},
        {.name = "use",
         .type = "fun(self: Component, set: string): string",
         .called = true,
         .most = 1,
         .usage = " \"SET\"",
         .doc = "switches to a named set of parameters"},
        {.name = "version",
         .type = "integer",
         .doc = "version number of the script, from 1",
         .value = of_component<[](const Component& component) { return std::int64_t{component.version()}; }>},
    };
    return members;
}

std::vector<std::string_view> taken_names(bool of_robots) {
    std::vector<std::string_view> names;
    for (const MemberInfo& member : all_members()) {
        if (!member.yields && (of_robots || !member.robot)) names.push_back(member.name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

Truth seen_truth(const World& world, RobotId robot) {
    Truth truth = world.truth(robot);
    for (double* value : {&truth.pose.position.x, &truth.pose.position.y, &truth.pose.heading, &truth.velocity.vx,
                          &truth.velocity.vy, &truth.velocity.va, &truth.height, &truth.tilt}) {
        if (std::abs(*value) < dust) *value = 0;
    }
    return truth;
}

std::span<const MemberInfo> component_members() { return all_members(); }

const MemberInfo* find_member(std::span<const MemberInfo> members, std::string_view name) {
    const auto found =
        std::find_if(members.begin(), members.end(), [&](const MemberInfo& each) { return each.name == name; });
    return found != members.end() ? &*found : nullptr;
}

const std::vector<std::string_view>& names_taken_by_components() {
    static const std::vector<std::string_view> names = taken_names(false);
    return names;
}

const std::vector<std::string_view>& names_taken_by_robots() {
    static const std::vector<std::string_view> names = taken_names(true);
    return names;
}

}  // namespace nezumi
