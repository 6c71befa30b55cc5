// Only texts exactly in the driver's format are accepted.
#include "hw/raspimouse/codec.hpp"

#include <charconv>

namespace nezumi::hw {
namespace {

// Takes one number and the character after it from the front. `end` is the character after the last number.
std::optional<int> take_number(std::string_view& text, char end) {
    int value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    if (text.empty() || text.front() != end) return std::nullopt;
    text.remove_prefix(1);
    return value;
}

std::optional<int> only_number(std::string_view text) {
    const auto value = take_number(text, '\n');
    return text.empty() ? value : std::nullopt;
}

}  // namespace

std::optional<LightValues> decode_lights(std::string_view text) {
    LightValues values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto value = take_number(text, i + 1 < values.size() ? ' ' : '\n');
        if (!value) return std::nullopt;
        values[i] = *value;
    }
    return text.empty() ? std::optional(values) : std::nullopt;
}

std::optional<bool> decode_switch(std::string_view text) {
    const auto value = only_number(text);
    if (!value || (*value != 0 && *value != 1)) return std::nullopt;
    return *value == 0;
}

std::optional<std::uint16_t> decode_counter(std::string_view text) {
    const auto value = only_number(text);
    if (!value || *value < -32768 || *value > 65535) return std::nullopt;
    return static_cast<std::uint16_t>(*value);
}

std::string encode_number(int value) { return std::to_string(value); }

std::string encode_switch(bool on) { return on ? "1" : "0"; }

}  // namespace nezumi::hw
