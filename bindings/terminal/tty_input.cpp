// Decodes characters without the C library, so that the result does not depend on the locale.
#include "bindings/terminal/tty_input.hpp"

#include <array>
#include <cstddef>

namespace nezumi {
namespace {

constexpr char escape = '\x1b';
constexpr wchar_t replacement = 0xFFFD;

struct Decoded {
    wchar_t character = replacement;
    std::size_t size = 1;  // 0: incomplete
};

Decoded decode(std::string_view bytes) {
    const auto first = static_cast<unsigned char>(bytes[0]);
    if (first < 0x80) return {static_cast<wchar_t>(first), 1};
    std::size_t size = 0;
    unsigned value = 0;
    if (first >= 0xC2 && first < 0xE0) {
        size = 2;
        value = first & 0x1FU;
    } else if (first >= 0xE0 && first < 0xF0) {
        size = 3;
        value = first & 0x0FU;
    } else if (first >= 0xF0 && first < 0xF5) {
        size = 4;
        value = first & 0x07U;
    } else {
        return {};
    }
    for (std::size_t at = 1; at < size; ++at) {
        if (at == bytes.size()) return {replacement, 0};
        const auto byte = static_cast<unsigned char>(bytes[at]);
        if ((byte & 0xC0U) != 0x80U) return {replacement, at};
        value = value << 6U | (byte & 0x3FU);
    }
    static constexpr std::array<unsigned, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = value >= 0xD800 && value < 0xE000;
    if (value < least[size] || value > 0x10FFFF || surrogate) return {replacement, size};
    return {static_cast<wchar_t>(value), size};
}

std::optional<Key> arrow(char letter) {
    switch (letter) {
        case 'A': return Key::up;
        case 'B': return Key::down;
        case 'C': return Key::right;
        case 'D': return Key::left;
        default: return std::nullopt;
    }
}

}  // namespace

TypedKey next_key(std::string_view typed, bool alone) {
    if (typed[0] == '\x03') return {.key = {}, .interrupt = true, .size = 1};
    if (typed[0] == ' ') return {.key = Key::space, .size = 1};
    if (typed[0] == '+') return {.key = Key::faster, .size = 1};
    if (typed[0] == '-') return {.key = Key::slower, .size = 1};
    if (typed[0] != escape) return {.key = {}, .size = 1};
    if (typed.size() == 1) return alone ? TypedKey{.key = Key::escape, .size = 1} : TypedKey{};
    // ESC O A in application mode; otherwise ESC [ A, with parameters in between for Shift and other modifiers.
    if (typed[1] == 'O') {
        if (typed.size() == 2) return alone ? TypedKey{.key = Key::escape, .size = 1} : TypedKey{};
        return {.key = arrow(typed[2]), .size = 3};
    }
    if (typed[1] != '[') return {.key = Key::escape, .size = 1};
    for (std::size_t at = 2; at < typed.size(); ++at) {
        if (typed[at] >= 0x40 && typed[at] <= 0x7E) return {.key = arrow(typed[at]), .size = at + 1};
    }
    return alone ? TypedKey{.key = {}, .size = typed.size()} : TypedKey{};
}

std::optional<wchar_t> take_character(std::string& typed) {
    if (typed.empty()) return std::nullopt;
    const Decoded decoded = decode(typed);
    if (decoded.size == 0) return std::nullopt;
    typed.erase(0, decoded.size);
    return decoded.character;
}

std::string to_utf8(std::wstring_view text) {
    std::string bytes;
    for (const wchar_t wide : text) {
        const auto value = static_cast<char32_t>(wide);
        const auto tail = [&](unsigned shift) { return static_cast<char>(0x80U | (value >> shift & 0x3FU)); };
        if (value < 0x80) {
            bytes += static_cast<char>(value);
        } else if (value < 0x800) {
            bytes += {static_cast<char>(0xC0U | value >> 6U), tail(0)};
        } else if (value < 0x10000) {
            bytes += {static_cast<char>(0xE0U | value >> 12U), tail(6), tail(0)};
        } else {
            bytes += {static_cast<char>(0xF0U | value >> 18U), tail(12), tail(6), tail(0)};
        }
    }
    return bytes;
}

std::wstring to_wide(std::string_view text) {
    std::wstring wide;
    while (!text.empty()) {
        const Decoded decoded = decode(text);
        wide += decoded.character;
        text.remove_prefix(decoded.size == 0 ? text.size() : decoded.size);
    }
    return wide;
}

}  // namespace nezumi
