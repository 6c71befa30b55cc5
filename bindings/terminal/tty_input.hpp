// Decodes bytes typed at a terminal into characters for the line editor and keys for driving.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bindings/console/session.hpp"

namespace nezumi {

/// A lone Escape is one when nothing follows it for so long [ms]; until then it may begin what another key sends.
inline constexpr int escape_wait = 50;

/// A decoded piece from the front of the input.
struct TypedKey {
    std::optional<Key> key;  ///< none: another key
    bool interrupt = false;  ///< Ctrl-C
    std::size_t size = 0;    ///< [bytes] that it took; 0: more must come before it is known
};

/// The key that begins `typed`, which is not empty. An escape that nothing follows is the key of that name only when
/// `alone`: otherwise the rest of an arrow key may still come.
TypedKey next_key(std::string_view typed, bool alone);

/// Takes the character from the front of `typed`: 0xFFFD for bytes that are no UTF-8; nothing when more must come.
std::optional<wchar_t> take_character(std::string& typed);

/// UTF-8 of a text.
std::string to_utf8(std::wstring_view text);
/// A text of UTF-8.
std::wstring to_wide(std::string_view text);

}  // namespace nezumi
