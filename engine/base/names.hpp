// Names that components, ports and parameters may have.
#pragma once

#include <span>
#include <string_view>

namespace nezumi {

/// Lua's keywords, sorted. This is the one list for the lexer, completion and names.
std::span<const std::string_view> lua_keywords();
/// Whether this is a keyword of Lua.
bool is_keyword(std::string_view name);
/// Whether a name has only letters, digits and underscores, does not begin with a digit, and is not a keyword of Lua.
bool is_identifier(std::string_view name);

/// The public names, sorted: the functions and tables for behaviours, for system and scenario files and for the
/// console, and names that are reserved for later. Every name that nezumi exports to Lua must be in this list; a test
/// checks this.
std::span<const std::string_view> promised_words();
/// Whether components can't have this name: a keyword of Lua, or one of `promised_words`.
bool is_reserved_name(std::string_view name);

}  // namespace nezumi
