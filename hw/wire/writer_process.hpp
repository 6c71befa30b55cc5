// The process that writes to a device: it completes messages that it has begun, and stops the device when the engine
// can't.
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

/// The largest number of descriptors with an order: those of a `WriteTarget`.
inline constexpr std::size_t most_files = 1 + most_pwm_channels;

/// An order from the engine to the writer. Each is one packet: this structure, then bytes.
struct WriterOrder {
    enum class Kind : std::uint8_t {
        device,   ///< use the device with these descriptors from now on. The bytes are `end_size` bytes that end a torn
                  ///< message, then the safe bytes; the writer sends both immediately.
        message,  ///< send the bytes
        beat,     ///< the control loop is alive at `tm`, and the device may be moving something
        release,  ///< stop the device and close it; the engine opens it again when it is back
        stop,     ///< drop waiting messages, complete a message that was begun, and send the safe bytes
    };
    Kind kind = Kind::beat;
    WriteBy by = WriteBy::stream;  ///< how to write to the device
    std::uint8_t end_size = 0;
    std::uint16_t address = 0;  ///< of a device on an I2C bus
    double tm = 0;              ///< [s] by `clock_seconds`
};

/// A message from the writer to the engine, one packet each.
struct WriterAnswer {
    enum class Kind : std::uint8_t {
        lost,     ///< the device does not accept messages: `error`
        stopped,  ///< no beat came in time, so the safe bytes were sent
        dropped,  ///< the device is too slow: its oldest message that waited was dropped
        answer,   ///< followed by the bytes of a message, and the bytes that the device has sent at the same time
    };
    Kind kind = Kind::lost;
    int error = 0;  ///< `errno`
    double tm = 0;  ///< [s] by `clock_seconds`, of an answer
};

/// The writer's main function: runs until the engine has ended, and never returns. The arguments are those of
/// `be_guard`. Allocates nothing.
[[noreturn]] void be_writer(int socket, int lease, pid_t engine, const ProcessWords& words);

}  // namespace nezumi::hw
