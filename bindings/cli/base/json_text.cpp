// Escapes byte by byte, after a check that the bytes are UTF-8 (RFC 3629, table of section 4).
#include "bindings/cli/base/json_text.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace nezumi::cli {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

// The length of the character at `i`, from 2 to 4 bytes; 0 if it is invalid.
std::size_t character_size(std::string_view text, std::size_t i) {
    const unsigned first = byte_at(text, i);
    const unsigned second = byte_at(text, i + 1);
    const std::size_t size = first >= 0xc2 && first <= 0xdf   ? 2
                             : (first & 0xf0U) == 0xe0        ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
    for (std::size_t k = 1; k < size; ++k) {
        if ((byte_at(text, i + k) & 0xc0U) != 0x80) return 0;
    }
    const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool beyond = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
    return overlong || beyond ? 0 : size;
}

}  // namespace

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80) {
            const std::size_t size = character_size(text, i);
            if (size == 0) {
                out += "\\ufffd";
                ++i;
            } else {
                out += text.substr(i, size);
                i += size;
            }
            continue;
        }
        ++i;
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (c == '\n') {
            out += "\\n";
        } else if (c == '\t') {
            out += "\\t";
        } else if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\u{:04x}", byte);
        } else {
            out += c;
        }
    }
    return out + '"';
}

}  // namespace nezumi::cli
