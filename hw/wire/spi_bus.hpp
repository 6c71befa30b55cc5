// Transfers on SPI with Linux's spidev.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nezumi::hw {

/// Sets the mode (0 to 3), words of 8 bits, and the maximum speed [Hz]. Returns an `errno`, or 0.
int spi_set_up(int file, std::uint8_t mode, std::uint32_t speed);

/// Sends `size` bytes while the device is selected. Receives the same number of bytes if `received` is not null.
/// Returns an `errno`, or 0. Allocates nothing.
int spi_transfer(int file, const char* sent, char* received, std::size_t size);

}  // namespace nezumi::hw
