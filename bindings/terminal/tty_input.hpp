// Decodes typed bytes into characters for the line editor and keys for driving.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bindings/console/session.hpp"

namespace nezumi {

/// If no byte follows an Escape within this time [ms], it is the key Escape; otherwise it may begin the sequence of
/// another key.
inline constexpr int escape_wait = 50;

/// A decoded part from the front of the input.
struct TypedKey {
    std::optional<Key> key;  ///< nothing: a key that `drive` does not use
    bool interrupt = false;  ///< Ctrl-C
    std::size_t size = 0;    ///< [bytes] used; 0: incomplete
};

/// Decodes the first key of `typed`, which must not be empty. A single escape is the key of that name only if `alone`:
/// otherwise the rest of an arrow key may still come.
TypedKey next_key(std::string_view typed, bool alone);

/// Takes the first character of `typed`: 0xFFFD for bytes that are not UTF-8, nothing if incomplete.
std::optional<wchar_t> take_character(std::string& typed);

/// Converts to UTF-8.
std::string to_utf8(std::wstring_view text);
/// Converts from UTF-8.
std::wstring to_wide(std::string_view text);

}  // namespace nezumi
