// Every member of a component stands here, once.
#include "bindings/lua/values/member_names.hpp"

#include <algorithm>

#include "engine/ports/usage.hpp"
#include "engine/system/act_fields.hpp"

namespace nezumi {
namespace {

const std::vector<MemberName>& all_members() {
    static const std::vector<MemberName> members{
        {.name = "activate", .called = true, .usage = "()", .doc = "makes it ACTIVE; gives the status that follows"},
        {.name = "buzzer", .robot = true, .yields = true, .doc = "what its buzzer sounds [Hz], 0 for nothing"},
        {.name = "collided", .robot = true, .doc = "whether it touches something"},
        {.name = "commands", .yields = true, .doc = "the names of its commands", .instead = "its script declares them"},
        {.name = "config", .doc = "its parameters, read and written within their bounds"},
        {.name = "deactivate",
         .called = true,
         .usage = "()",
         .doc = "makes it INACTIVE; gives the status that follows"},
        {.name = "disturb",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 1,
         .usage = " " + usage_of<Push>(Describe<Push>::at_once),
         .doc = "a hand forces these speeds on it; without them the hand lets go"},
        {.name = "error", .yields = true, .doc = "what went wrong last, or nil"},
        {.name = "leds",
         .robot = true,
         .yields = true,
         .doc = "which of its lights are on",
         .instead = "write the port that switches them"},
        {.name = "limits",
         .robot = true,
         .yields = true,
         .doc = "the highest speeds and accelerations that it obeys",
         .instead = "the system file says them"},
        {.name = "name", .doc = "its name"},
        {.name = "ports", .doc = "its ports by name"},
        {.name = "press",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 2,
         .usage = "(sensor, pressed)",
         .doc = "presses a button or touch sensor; with false lets it go"},
        {.name = "probes",
         .doc = "what its script shows by `probe`: value, tm and age of each",
         .instead = "its script shows them"},
        {.name = "rate", .yields = true, .doc = "executions a second [Hz]"},
        {.name = "reset", .called = true, .usage = "()", .doc = "takes it out of ERROR; gives the status that follows"},
        {.name = "said",
         .robot = true,
         .yields = true,
         .doc = "the last 100 texts that its speaker was given",
         .instead = "what it is to say goes to the port of its speaker"},
        {.name = "set", .yields = true, .doc = "the named set of parameters in use, or nil"},
        {.name = "sets", .doc = "the names of its sets of parameters", .instead = "the system file says them"},
        {.name = "state",
         .doc = "a copy of what its script keeps in `state`",
         .instead = "a command of its script can change it"},
        {.name = "status", .doc = "\"INACTIVE\", \"ACTIVE\" or \"ERROR\""},
        {.name = "tasks",
         .doc = "its tasks: status, since, waiting and line of each",
         .instead = "its script declares them"},
        {.name = "teleport",
         .robot = true,
         .called = true,
         .yields = true,
         .most = 1,
         .usage = "(pose)",
         .doc = "carries it to a pose, at rest"},
        {.name = "touching", .robot = true, .yields = true, .doc = "what it touches, or nil"},
        {.name = "truth", .robot = true, .doc = "what the simulation knows of it: pose, velocity, height, tilt"},
        {.name = "type", .doc = "its component type"},
        {.name = "use", .called = true, .most = 1, .usage = " \"SET\"", .doc = "switches to a named set of parameters"},
        {.name = "version", .doc = "counts the versions of its script, from 1"},
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

const std::vector<std::string_view>& component_words() {
    static const std::vector<std::string_view> names = taken_names(false);
    return names;
}

const std::vector<std::string_view>& robot_words() {
    static const std::vector<std::string_view> names = taken_names(true);
    return names;
}

}  // namespace nezumi
