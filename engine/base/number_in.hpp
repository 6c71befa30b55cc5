// Converts texts to numbers, and words for the bounds of numbers.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace nezumi {

/// Converts a whole text to a number. Nothing if the text has anything else (blanks, a plus sign), or if the type can't
/// hold the number. `base` is the base of a whole number; 10 if it is omitted.
template <class Number, class... Base>
std::optional<Number> number_in(std::string_view text, Base... base) {
    Number number{};
    const char* const last = text.data() + text.size();
    const auto [end, problem] = std::from_chars(text.data(), last, number, base...);
    if (problem != std::errc() || end != last) return std::nullopt;
    return number;
}

/// The same for a number that is neither infinite nor NaN.
inline std::optional<double> finite_in(std::string_view text) {
    const auto number = number_in<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

/// Like `finite_in`, but the number may have a plus sign, because files of other programs have such numbers.
inline std::optional<double> signed_finite_in(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    return finite_in(text);
}

/// What is expected instead of a number above `most` or below -`most`: "a number up to 5", "a number from -5 on".
inline std::string number_within(double most, double got) {
    return got < 0 ? fmt::format("a number from {} on", -most) : fmt::format("a number up to {}", most);
}

}  // namespace nezumi
