// Lines of a GPIO chip, by the kernel's character device, and PWM channels, by sysfs.
//
// The kernel's own interface (<linux/gpio.h>, version 2, since Linux 5.10) is used rather than libgpiod: it is the same
// on every Debian, where libgpiod 1.6 and 2 have different functions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "hw/wire/write_target.hpp"

namespace nezumi::hw {

/// Levels for output lines and PWM channels, by their index among the requested ones. The writer's process receives
/// messages in this form.
struct GpioLevels {
    std::uint64_t lines = 0;   ///< a bit for each line: 1 if it is to be set
    std::uint64_t levels = 0;  ///< a bit for each line: its new level
    std::uint8_t channels = 0;
    std::array<std::uint64_t, most_pwm_channels> duty{};  ///< [ns] of each of `channels`
};

/// Sets lines and channels. Returns an `errno`, or 0. Allocates nothing. `pwm`: the open file duty_cycle of each
/// channel.
int set_gpio(int lines, const std::array<int, most_pwm_channels>& pwm, const GpioLevels& levels);

/// Requests lines of a chip as outputs and sets their levels at once, one bit a line. Returns an empty descriptor and
/// sets `errno` if a line does not exist or is in use (EBUSY).
Descriptor request_outputs(int chip, const std::vector<std::int64_t>& lines, std::uint64_t levels);
enum class Pull { none, up, down };
/// Requests lines as inputs whose edges are reported. `debounce`: [s] that a level must last; 0: every edge is
/// reported.
Descriptor request_inputs(int chip, const std::vector<std::int64_t>& lines, Pull pull, double debounce);

/// The level of an input at a time.
struct GpioEdge {
    double tm = 0;  ///< [s] by `clock_seconds`: when the kernel handled the interrupt
    std::int64_t line = 0;
    bool level = false;
};
/// Appends the edges since the last call. Returns an `errno`, or 0.
int read_edges(int inputs, std::vector<GpioEdge>& edges);
/// Appends the present levels as edges. Returns an `errno`, or 0.
int read_levels(int inputs, const std::vector<std::int64_t>& lines, std::vector<GpioEdge>& edges);
/// True if the open file is a GPIO chip with version 2 of the kernel's interface.
bool is_gpio_chip(int file);

}  // namespace nezumi::hw
