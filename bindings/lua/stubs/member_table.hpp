// The members of components and ports as annotations and as tables of the documentation.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {

/// `---@field status ...`, a line.
std::string annotation(const MemberInfo& member);

/// A Markdown table with a line for each member. `owner` is "X" or "port".
std::string member_table(std::span<const MemberInfo> members, std::string_view owner);

/// A page with the tables that it asks for: `<!-- members: component -->`, `<!-- members: port -->`.
Expected<std::string> with_member_tables(std::string_view page);

}  // namespace nezumi
