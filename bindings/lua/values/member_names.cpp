// Every member of a component and of a port stands here, once.
#include "bindings/lua/values/member_names.hpp"

#include <algorithm>

#include "engine/ports/usage.hpp"
#include "engine/system/act_fields.hpp"

namespace nezumi {
namespace {

const std::vector<MemberName>& all_members() {
    static const std::vector<MemberName> members{
        {.name = "activate",
         .type = "fun(self: Component): string",
         .called = true,
         .usage = "()",
         .doc = "makes it ACTIVE; gives the status that follows"},
        {.name = "buzzer",
         .type = "integer",
         .robot = true,
         .yields = true,
         .doc = "what its buzzer sounds [Hz], 0 for nothing"},
        {.name = "collided", .type = "boolean", .robot = true, .doc = "whether it touches something"},
        {.name = "commands",
         .type = "string[]",
         .yields = true,
         .doc = "the names of its commands",
         .instead = "its script declares them"},
        {.name = "config",
         .type = "table<string, ParameterValue>",
         .doc = "its parameters, read and written within their bounds"},
        {.name = "deactivate",
         .type = "fun(self: Component): string",
         .called = true,
         .usage = "()",
         .doc = "makes it INACTIVE; gives the status that follows"},
        {.name = "disturb",
         .type = "fun(self: Component, velocities?: VelocityConstraintFields)",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 1,
         .usage = " " + usage_of<VelocityConstraint>(Describe<VelocityConstraint>::at_once),
         .doc = "forces these speeds on it, as a hand would; without them it moves freely again"},
        {.name = "error", .type = "string?", .yields = true, .doc = "its last error, or nil"},
        {.name = "leds",
         .type = "boolean[]",
         .robot = true,
         .yields = true,
         .doc = "which of its lights are on",
         .instead = "write the port that switches them"},
        {.name = "limits",
         .type = "table<string, number>",
         .robot = true,
         .yields = true,
         .doc = "the highest speeds and accelerations that it obeys",
         .instead = "the system file says them"},
        {.name = "name", .type = "string", .doc = "its name"},
        {.name = "ports", .type = "table<string, Port>", .doc = "its ports by name"},
        {.name = "press",
         .type = "fun(self: Component, sensor: string, pressed?: boolean)",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 2,
         .usage = "(sensor, pressed)",
         .doc = "presses a button or touch sensor; with false lets it go"},
        {.name = "probes",
         .type = "table<string, ProbeView>",
         .doc = "what its script shows by `probe`: value, tm and age of each",
         .instead = "its script shows them"},
        {.name = "rate", .type = "number", .yields = true, .doc = "executions a second [Hz]"},
        {.name = "reset",
         .type = "fun(self: Component): string",
         .called = true,
         .usage = "()",
         .doc = "takes it out of ERROR; gives the status that follows"},
        {.name = "said",
         .type = "string[]",
         .robot = true,
         .yields = true,
         .doc = "the last 100 texts that its speaker was given",
         .instead = "what it is to say goes to the port of its speaker"},
        {.name = "set", .type = "string?", .yields = true, .doc = "the named set of parameters in use, or nil"},
        {.name = "sets",
         .type = "string[]",
         .doc = "the names of its sets of parameters",
         .instead = "the system file says them"},
        {.name = "state",
         .type = "table",
         .doc = "a copy of what its script keeps in `state`",
         .instead = "a command of its script can change it"},
        {.name = "status", .type = R"("INACTIVE"|"ACTIVE"|"ERROR")", .doc = "\"INACTIVE\", \"ACTIVE\" or \"ERROR\""},
        {.name = "tasks",
         .type = "table<string, TaskView>",
         .doc = "its tasks: status, since, waiting and line of each",
         .instead = "its script declares them"},
        {.name = "teleport",
         .type = "fun(self: Component, pose: PoseFields)",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 1,
         .usage = "(pose)",
         .doc = "puts it at a pose, at rest"},
        {.name = "touching", .type = "string?", .robot = true, .yields = true, .doc = "what it touches, or nil"},
        {.name = "truth",
         .type = "{ pose: Pose2D, velocity: Velocity2D, height: number, tilt: number }",
         .robot = true,
         .doc = "what the simulation knows of it: pose, velocity, height, tilt"},
        {.name = "type", .type = "string", .doc = "its component type"},
        {.name = "use",
         .type = "fun(self: Component, set: string): string",
         .called = true,
         .most = 1,
         .usage = " \"SET\"",
         .doc = "switches to a named set of parameters"},
        {.name = "version", .type = "integer", .doc = "counts the versions of its script, from 1"},
    };
    return members;
}

const std::vector<MemberName>& all_port_members() {
    static const std::vector<MemberName> members{
        {.name = "age", .type = "number", .doc = "how long ago its stamp was [s]; math.huge before anything came"},
        {.name = "connected", .type = "boolean", .doc = "whether another port is connected to it"},
        {.name = "count", .type = "integer", .doc = "messages since the start"},
        {.name = "direction", .type = R"("in"|"out")", .doc = "whether its component reads or writes it"},
        {.name = "doc", .type = "string", .doc = "its description"},
        {.name = "drop",
         .type = "fun(self: Port)",
         .called = true,
         .most = 0,
         .usage = "()",
         .doc = "no message gets through until release"},
        {.name = "freeze",
         .type = "fun(self: Port)",
         .called = true,
         .most = 0,
         .usage = "()",
         .doc = "the present value is repeated until release"},
        {.name = "hold",
         .type = "fun(self: Port, value: any, options?: HoldOptions)",
         .called = true,
         .most = 2,
         .usage = "(value, { take = true })",
         .doc = "only this value gets through until release"},
        {.name = "holder", .type = "string?", .doc = "who holds, drops or freezes it, or nil"},
        {.name = "inject",
         .type = "fun(self: Port, value: any)",
         .called = true,
         .most = 1,
         .usage = "(value)",
         .doc = "one message, as from a connection"},
        {.name = "name", .type = "string", .doc = "its name"},
        {.name = "note", .type = "string", .doc = "a note of its robot, for example that commands are ignored"},
        {.name = "override", .type = "string", .doc = R"("held", "dropped", "frozen" or "")"},
        {.name = "path", .type = "string", .doc = R"("name.port")"},
        {.name = "peers", .type = "string[]", .doc = "the ports at its other end"},
        {.name = "release",
         .type = "fun(self: Port)",
         .called = true,
         .most = 0,
         .usage = "()",
         .doc = "ends what hold, drop and freeze began"},
        {.name = "stale",
         .type = "boolean",
         .doc = "whether it is overdue: nothing came for three periods of its sender, at least 0.1 s, where that "
                "declares a rate, for 0.5 s otherwise"},
        {.name = "tm", .type = "number", .doc = "its stamp [s], 0 before anything came"},
        {.name = "type", .type = "MessageType", .doc = "its message type"},
        {.name = "unread",
         .type = "boolean",
         .doc = "of an in-port: whether something waits that its component has not read"},
        {.name = "value",
         .type = "any",
         .doc = "a copy of the latest message; looking consumes nothing. Before anything came, the zero value of its "
                "type"},
        {.name = "write",
         .type = "fun(self: Port, value: any)",
         .called = true,
         .most = 1,
         .usage = "(value)",
         .doc = "an out-port: published as if its component had written it; an in-port: as inject"},
    };
    return members;
}

std::vector<std::string_view> taken_names(bool of_robots) {
    std::vector<std::string_view> names;
    for (const MemberName& member : all_members()) {
        if (!member.yields && (of_robots || !member.robot)) names.push_back(member.name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

std::span<const MemberName> member_names() { return all_members(); }

std::span<const MemberName> port_member_names() { return all_port_members(); }

const std::vector<std::string_view>& component_members() {
    static const std::vector<std::string_view> names = taken_names(false);
    return names;
}

const std::vector<std::string_view>& robot_members() {
    static const std::vector<std::string_view> names = taken_names(true);
    return names;
}

}  // namespace nezumi
