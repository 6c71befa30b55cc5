// Every member of a component stands here, once.
#include "bindings/lua/values/member_names.hpp"

#include <algorithm>
#include <array>

namespace nezumi {
namespace {

constexpr std::array<MemberName, 28> members{{
    {.name = "activate", .called = true, .usage = "()"},
    {.name = "buzzer", .robot = true, .yields = true},
    {.name = "collided", .robot = true},
    {.name = "commands", .yields = true},
    {.name = "config"},
    {.name = "deactivate", .called = true, .usage = "()"},
    {.name = "disturb", .robot = true, .called = true, .yields = true, .most = 1, .usage = " { vx =, va = }"},
    {.name = "error", .yields = true},
    {.name = "leds", .robot = true, .yields = true},
    {.name = "limits", .robot = true, .yields = true},
    {.name = "name"},
    {.name = "ports"},
    {.name = "press", .robot = true, .called = true, .yields = true, .most = 2, .usage = "(sensor, pressed)"},
    {.name = "probes"},
    {.name = "rate", .yields = true},
    {.name = "reset", .called = true, .usage = "()"},
    {.name = "said", .robot = true, .yields = true},
    {.name = "set", .yields = true},
    {.name = "sets"},
    {.name = "state"},
    {.name = "status"},
    {.name = "tasks"},
    {.name = "teleport", .robot = true, .called = true, .yields = true, .most = 1, .usage = "(pose)"},
    {.name = "touching", .robot = true, .yields = true},
    {.name = "truth", .robot = true},
    {.name = "type"},
    {.name = "use", .called = true, .most = 1, .usage = " \"SET\""},
    {.name = "version"},
}};

std::vector<std::string_view> taken_names(bool of_robots) {
    std::vector<std::string_view> names;
    for (const MemberName& member : members) {
        if (!member.yields && (of_robots || !member.robot)) names.push_back(member.name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

std::span<const MemberName> member_names() { return members; }

const std::vector<std::string_view>& component_words() {
    static const std::vector<std::string_view> names = taken_names(false);
    return names;
}

const std::vector<std::string_view>& robot_words() {
    static const std::vector<std::string_view> names = taken_names(true);
    return names;
}

}  // namespace nezumi
