// Own checks, because the parser's messages name its types.
#include "bindings/cli/shell/option_checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "engine/base/error.hpp"

namespace nezumi::cli {

OptionCheck whole_number(std::uint64_t least, std::uint64_t most, const std::string& most_text) {
    return [least, most, most_text](const std::string& text) -> std::string {
        std::uint64_t number = 0;
        const char* const last = text.data() + text.size();
        const auto [end, problem] = std::from_chars(text.data(), last, number);
        if (problem == std::errc() && end == last && number >= least && number <= most) return "";
        return fmt::format("expected a whole number from {} to {}, got '{}'", least, most_text, shown(text));
    };
}

OptionCheck number_from(double least, double most) {
    return [least, most](const std::string& text) -> std::string {
        double number = 0;
        const char* const last = text.data() + text.size();
        const auto [end, problem] = std::from_chars(text.data(), last, number);
        if (problem == std::errc() && end == last && number >= least && number <= most) return "";
        return fmt::format("expected a number from {} to {}, got '{}'", least, most, shown(text));
    };
}

std::string not_empty(const std::string& text) { return text.empty() ? "expected a value, got ''" : ""; }

}  // namespace nezumi::cli
