// Splits a message into words, each with a name and a value.
#include "engine/devices/gpio_message.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/base/list.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi {
namespace {

tl::expected<GpioLevel, std::string> read_level(std::string_view word, const GpioOutputs& outputs) {
    constexpr std::string_view pwm = "pwm";
    GpioLevel level{.is_pwm = word.starts_with(pwm)};
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string_view name = word.substr(level.is_pwm ? pwm.size() : 0, equals - (level.is_pwm ? pwm.size() : 0));
    const auto number = number_in<std::int64_t>(name);
    const auto value = number_in<double>(word.substr(std::min(equals + 1, word.size())));
    if (!number || !value)
        return tl::unexpected(
            fmt::format("'{}': expected LINE=LEVEL, such as 23=1, or pwmCHANNEL=DUTY, such as pwm0=0.25", shown(word)));
    level.number = *number;
    level.value = *value;
    const auto& known = level.is_pwm ? outputs.pwm_channels : outputs.lines;
    if (!contains(known, level.number))
        return tl::unexpected(fmt::format("'{}': {} is not one of {} ({})", shown(word), level.number,
                                          level.is_pwm ? "pwm_channels" : "outputs", fmt::join(known, ", ")));
    if (level.is_pwm && !(level.value >= 0 && level.value <= 1))
        return tl::unexpected(fmt::format("'{}': expected a duty from 0 to 1", shown(word)));
    if (!level.is_pwm && level.value != 0 && level.value != 1)
        return tl::unexpected(fmt::format("'{}': expected the level 0 or 1", shown(word)));
    return level;
}

}  // namespace

tl::expected<std::vector<GpioLevel>, std::string> read_gpio_message(std::string_view text, const GpioOutputs& outputs) {
    std::vector<GpioLevel> levels;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        if (end > 0) {
            const auto level = read_level(text.substr(0, end), outputs);
            if (!level) return tl::unexpected(level.error());
            levels.push_back(*level);
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return levels;
}

}  // namespace nezumi
