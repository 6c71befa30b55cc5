// Works on bytes, so text in any encoding is accepted.
#include "engine/base/visible.hpp"

#include <array>
#include <cstdio>

namespace nezumi {
namespace {

constexpr std::string_view margin = "            | ";  // as wide as the time at the start of a log line

// The code of a three-byte character at this position; 0 if there is none.
unsigned three_bytes(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) -> unsigned {
        return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
    };
    if ((byte(0) & 0xf0U) != 0xe0U || (byte(1) & 0xc0U) != 0x80U || (byte(2) & 0xc0U) != 0x80U) return 0;
    return (byte(0) & 0x0fU) << 12U | (byte(1) & 0x3fU) << 6U | (byte(2) & 0x3fU);
}

// Direction marks, embeddings, overrides and isolates, and the separators of lines and paragraphs.
bool is_hidden(unsigned code) {
    return code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string visible(std::string_view text) {
    std::string plain;
    plain.reserve(text.size());
    std::array<char, 8> written{};
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = static_cast<unsigned char>(text[at]);
        // U+0080 to U+009F, encoded in two bytes, are control characters too.
        const bool second =
            byte == 0xc2 && at + 1 < text.size() && (static_cast<unsigned char>(text[at + 1]) & 0xe0U) == 0x80U;
        const bool control = second || (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f;
        if (const unsigned code = control ? 0 : three_bytes(text, at); is_hidden(code)) {
            std::snprintf(written.data(), written.size(), "\\u%04x", code);
            plain += written.data();
            at += 2;
        } else if (control) {
            std::snprintf(written.data(), written.size(), "\\x%02x",
                          second ? static_cast<unsigned char>(text[++at]) : byte);
            plain += written.data();
        } else {
            plain += text[at];
        }
    }
    return plain;
}

std::string visible_message(std::string_view text) {
    const std::string plain = visible(text);
    std::string lines;
    for (const char c : plain) {
        lines += c;
        if (c == '\n') lines += margin;
    }
    return lines;
}

}  // namespace nezumi
