// The process that writes to a device: it completes what it has begun, and stops the device when the engine can't.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hw/guard/guard_process.hpp"
#include "hw/wire/write_target.hpp"

namespace nezumi::hw {

/// The longest message to a device [bytes], and the longest safe bytes.
inline constexpr std::size_t longest_message = 1024, longest_safe = 255;

/// The most descriptors that come with an order: of `WriteTarget`.
inline constexpr std::size_t most_files = 1 + most_pwm_channels;

/// A message from the engine to the writer, one packet each: this, and bytes.
struct WriterOrder {
    enum class Kind : std::uint8_t {
        device,   ///< with descriptors, in place of those before; the bytes: `end_size` that end a torn line, and the
                  ///< safe bytes. It sends both at once.
        message,  ///< the bytes: to be sent
        beat,     ///< the control loop is alive at `tm`, and what is sent may move something
        release,  ///< stops, and closes the device: the engine opens it again when it is back
        stop,     ///< drops what waits, completes a message that was begun, and sends the safe bytes
    };
    Kind kind = Kind::beat;
    WriteBy by = WriteBy::stream;  ///< of a device
    std::uint8_t end_size = 0;
    std::uint16_t address = 0;  ///< of a device on an I2C bus
    double tm = 0;              ///< [s] by `clock_seconds`
};

/// A message from the writer to the engine, one packet each.
struct WriterAnswer {
    enum class Kind : std::uint8_t {
        lost,     ///< the device does not take messages: `error`
        stopped,  ///< no beat came in time, so the safe bytes were sent
        dropped,  ///< the device is too slow: its oldest message that waited was dropped
        answer,   ///< followed by the bytes of a message, and as many that the device has sent meanwhile
    };
    Kind kind = Kind::lost;
    int error = 0;  ///< `errno`
    double tm = 0;  ///< [s] by `clock_seconds`, of an answer
};

/// The writer's main function, until its engine has ended; never returns. Arguments as of `be_guard`. Allocates
/// nothing.
[[noreturn]] void be_writer(int socket, int lease, pid_t engine, const ProcessWords& words);

}  // namespace nezumi::hw
