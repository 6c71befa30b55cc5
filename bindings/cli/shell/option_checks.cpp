// Own checks, because the parser's messages name its types.
#include "bindings/cli/shell/option_checks.hpp"

#include <fmt/format.h>


#include "engine/base/error.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi::cli {

OptionCheck whole_number(std::uint64_t least, std::uint64_t most, const std::string& most_text) {
    return [least, most, most_text](const std::string& text) -> std::string {
        const auto number = number_in<std::uint64_t>(text);
        if (number && *number >= least && *number <= most) return "";
        return fmt::format("expected a whole number from {} to {}, got '{}'", least, most_text, shown(text));
    };
}

OptionCheck number_from(double least, double most) {
    return [least, most](const std::string& text) -> std::string {
        const auto number = number_in<double>(text);
        if (number && *number >= least && *number <= most) return "";
        return fmt::format("expected a number from {} to {}, got '{}'", least, most, shown(text));
    };
}

std::string not_empty(const std::string& text) { return text.empty() ? "expected a value, got ''" : ""; }

}  // namespace nezumi::cli
