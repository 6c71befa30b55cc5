// The messages of GPIO: "23=1 24=0 pwm0=0.25".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace nezumi {

/// What a message sets.
struct GpioLevel {
    bool is_pwm = false;
    std::int64_t number = 0;  ///< of the line on its chip; of the channel on its PWM chip
    double value = 0;         ///< of a line 0 or 1; of a channel its duty, 0 to 1
};

/// The lines and channels that may be set.
struct GpioOutputs {
    const std::vector<std::int64_t>& lines;
    const std::vector<std::int64_t>& pwm_channels;
};

/// Reads a message. The error is one line.
tl::expected<std::vector<GpioLevel>, std::string> read_gpio_message(std::string_view text, const GpioOutputs& outputs);

}  // namespace nezumi
