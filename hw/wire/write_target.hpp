// Writes one message to a device, with the system call for this kind of device.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nezumi::hw {

inline constexpr std::size_t most_pwm_channels = 8;

/// How a message is written.
enum class WriteBy : std::uint8_t {
    stream,        ///< a stream of bytes, which may accept only a part of a message
    datagram,      ///< a socket: a message is sent whole or not at all, and its loss is not an error
    plain,         ///< a plain file, which contains only the last message
    i2c,           ///< one transaction with an address on an I2C bus
    spi,           ///< one transfer on SPI
    spi_answered,  ///< one transfer on SPI, whose answer is read
    gpio,          ///< levels of GPIO lines and PWM channels: `GpioLevels`
};

/// An open device for writing.
struct WriteTarget {
    WriteBy by = WriteBy::stream;
    std::uint16_t address = 0;  ///< on an I2C bus
    int file = -1;
    std::array<int, most_pwm_channels> pwm = no_files();  ///< for GPIO: the files duty_cycle of the channels; -1: none

    static constexpr std::array<int, most_pwm_channels> no_files() {
        std::array<int, most_pwm_channels> none{};
        none.fill(-1);
        return none;
    }
};

/// Tries a transaction at most three times, because motors disturb the lines of a bus. Returns its `errno`, or 0.
template <class Transaction>
int retry_transfer(const Transaction& transaction) {
    int error = 0;
    for (int left = 3; left > 0; --left) {
        error = transaction();
        if (error == 0) break;
    }
    return error;
}

/// Writes a message, or to a stream a part of it. Returns the number of bytes, or -1 with `errno`. A transaction is
/// tried at most three times. `answer`: for `spi_answered`, gets the same number of bytes. Allocates nothing.
ssize_t write_message(const WriteTarget& target, const char* bytes, std::size_t size, char* answer = nullptr);

}  // namespace nezumi::hw
