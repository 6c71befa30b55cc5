// Transactions on an I2C bus with Linux's i2c-dev.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nezumi::hw {

/// Checks that no driver of the kernel uses the device at this address. Returns EBUSY if one does, another `errno`, or
/// 0.
int i2c_claim(int bus, std::uint16_t address);

/// Reads a byte to test whether a device answers. Returns an `errno`, or 0.
int i2c_probe(int bus, std::uint16_t address);

/// Writes in one transaction. Returns an `errno`, or 0. Allocates nothing.
int i2c_write(int bus, std::uint16_t address, const char* bytes, std::size_t size);

/// Writes the number of a register and reads from there in one transaction, without a stop between them. Returns an
/// `errno`, or 0.
int i2c_read(int bus, std::uint16_t address, std::string_view first_register, char* bytes, std::size_t size);

}  // namespace nezumi::hw
