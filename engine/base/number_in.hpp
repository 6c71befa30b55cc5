// Numbers that are a whole text.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace nezumi {

/// The number that this whole text is, without blanks and without a plus sign; nothing for any other text, and for a
/// number that its type can't hold. `base`: of a whole number, if it is not 10.
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

/// The same, which may have a plus sign, as files of other programs have it.
inline std::optional<double> signed_finite_in(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    return finite_in(text);
}

}  // namespace nezumi
