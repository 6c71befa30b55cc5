// Characters of UTF-8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nezumi {

/// A character and its number of bytes; 0 bytes: invalid (an overlong form, a surrogate, an incomplete character).
struct Utf8Character {
    std::size_t size = 0;
    std::uint32_t code = 0;
};

/// The character at `at`, which is within `text`.
Utf8Character utf8_character(std::string_view text, std::size_t at);

/// Whether the whole text is valid UTF-8, so that other programs can read it.
bool is_utf8(std::string_view text);

}  // namespace nezumi
