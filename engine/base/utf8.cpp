// Decodes each character, as RFC 3629 defines them.
#include "engine/base/utf8.hpp"

namespace nezumi {

Utf8Character utf8_character(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(at);
    const std::size_t size = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
    if (size == 0 || at + size > text.size()) return {};
    std::uint32_t code = size == 1 ? first : first & (0x7fU >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if (byte(at + i) >> 6 != 2) return {};
        code = code << 6 | (byte(at + i) & 63U);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (code < least[size] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
    return {.size = size, .code = code};
}

bool is_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t size = utf8_character(text, at).size;
        if (size == 0) return false;
        at += size;
    }
    return true;
}

}  // namespace nezumi
