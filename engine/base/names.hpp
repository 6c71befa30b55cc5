// Which names components, ports and parameters may have.
#pragma once

#include <span>
#include <string_view>

namespace nezumi {

/// Lua's keywords, sorted: the one list for the lexer, for completion and for names.
std::span<const std::string_view> lua_keywords();
/// A keyword of Lua.
bool is_keyword(std::string_view name);
/// Letters, digits and underscores, not beginning with a digit, and no keyword of Lua.
bool is_identifier(std::string_view name);

/// The words that users are promised, sorted: those of behaviours, of system and scenario files, and of the console,
/// and those kept free for what is to come. A room that exports a word to Lua has it among these; a test compares them.
std::span<const std::string_view> promised_words();
/// What no component may be called: a keyword of Lua or a promised word.
bool is_reserved_name(std::string_view name);

}  // namespace nezumi
