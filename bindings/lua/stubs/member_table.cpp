// Writes the members as annotations and as tables.
#include "bindings/lua/stubs/member_table.hpp"

#include <fmt/format.h>

#include "bindings/lua/stubs/field_table.hpp"

namespace nezumi {
namespace {

std::string meaning(const MemberInfo& member) {
    return fmt::format("{}{}", member.robot ? "of robots: " : "", member.doc);
}

}  // namespace

std::string annotation(const MemberInfo& member) {
    return fmt::format("---@field {} {} {}\n", member.name, member.type, meaning(member));
}

std::string member_table(std::span<const MemberInfo> members, std::string_view owner) {
    std::string text = fmt::format("| `{}.` | |\n|---|---|\n", owner);
    for (const MemberInfo& member : members) {
        const std::string name = fmt::format("{}{}{}", member.called ? ":" : "", member.name, member.usage);
        text += fmt::format("| `{}` | {} |\n", name, meaning(member));
    }
    return text;
}

Expected<std::string> with_member_tables(std::string_view page) {
    return with_tables(page, "members", [](std::string_view name) -> Expected<std::string> {
        if (name == "component") return member_table(component_members(), "X");
        if (name == "port") return member_table(port_members(), "port");
        return failure(fmt::format("there are no members of '{}'", name));
    });
}

}  // namespace nezumi
