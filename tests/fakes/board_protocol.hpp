// What the preloaded `board_calls.cpp` and the `FakeBoard` say to each other: one packet for each ioctl, one answer.
#pragma once

#include <cstdint>

namespace nezumi::hw {

/// Followed by the argument's bytes. Of transfers: for each message a `BoardMessage`, and what it writes. With a
/// descriptor, to which the answer goes.
struct BoardCall {
    std::uint64_t request = 0;   ///< of the ioctl
    std::uint64_t argument = 0;  ///< itself, where it is a number
    std::uint32_t messages = 0;
};

/// A message of an I2C transaction, or a transfer of SPI.
struct BoardMessage {
    std::uint32_t size = 0;
    std::uint32_t speed = 0;    ///< [Hz] of SPI
    std::uint16_t address = 0;  ///< of I2C
    std::uint8_t reads = 0, writes = 0;
};

/// Followed by what was read, or by the argument's new bytes. With a descriptor, for requested lines.
struct BoardAnswer {
    std::int32_t result = 0;
    std::int32_t error = 0;  ///< `errno`
};

}  // namespace nezumi::hw
