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

/// The public words, sorted: those of behaviours, of system and scenario files, and of the console, and words that are
/// reserved for later. A word that a room exports to Lua must be in this list; a test checks this.
std::span<const std::string_view> promised_words();
/// Whether a component can't have this name: a keyword of Lua or a public word.
bool is_reserved_name(std::string_view name);

}  // namespace nezumi
