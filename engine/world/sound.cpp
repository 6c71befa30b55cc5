// Distinguishes tones from speech.
#include "engine/world/sound.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

constexpr std::string_view blanks(" \t\r\n\v\f\0", 7);

// Reads an integer of decimal digits, limited to `most`; nothing for any other text.
std::optional<int> read_number(std::string_view text, int most) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} ? std::min(value, most) : most;
}

}  // namespace

Sound read_sound(std::string_view told) {
    const std::string_view text = trimmed(told, blanks);
    if (text.empty()) return {};
    if (text == "beep") return {Sound::Kind::tone, 440, 0.2, {}};
    constexpr std::string_view tone = "tone,";
    if (text.substr(0, tone.size()) == tone) {
        const std::string_view numbers = text.substr(tone.size());
        const auto comma = std::min(numbers.find(','), numbers.size());
        const auto hertz = read_number(trimmed(numbers.substr(0, comma), blanks), highest_tone);
        const auto milliseconds =
            read_number(trimmed(numbers.substr(std::min(comma + 1, numbers.size())), blanks), longest_tone);
        if (hertz && milliseconds) return {Sound::Kind::tone, static_cast<double>(*hertz), *milliseconds / 1000.0, {}};
    }
    return {Sound::Kind::speech, 0, 0, std::string(text)};
}

}  // namespace nezumi
