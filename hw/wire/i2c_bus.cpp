// Each transfer is one ioctl: I2C_RDWR keeps no state in the open file, so reader and writer can share it.
#include "hw/wire/i2c_bus.hpp"

#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <sys/ioctl.h>

#include <array>
#include <cerrno>

namespace nezumi::hw {
namespace {

template <std::size_t count>
int transfer(int bus, std::array<i2c_msg, count> messages) {
    i2c_rdwr_ioctl_data all{.msgs = messages.data(), .nmsgs = count};
    return ioctl(bus, I2C_RDWR, &all) < 0 ? errno : 0;
}

i2c_msg message(std::uint16_t address, std::uint16_t flags, char* bytes, std::size_t size) {
    return {.addr = address,
            .flags = flags,
            .len = static_cast<std::uint16_t>(size),
            .buf = reinterpret_cast<std::uint8_t*>(bytes)};
}

}  // namespace

int i2c_claim(int bus, std::uint16_t address) {
    return ioctl(bus, I2C_SLAVE, static_cast<unsigned long>(address)) < 0 ? errno : 0;
}

int i2c_probe(int bus, std::uint16_t address) {
    char byte = 0;
    return transfer(bus, std::array{message(address, I2C_M_RD, &byte, 1)});
}

int i2c_write(int bus, std::uint16_t address, const char* bytes, std::size_t size) {
    return transfer(bus, std::array{message(address, 0, const_cast<char*>(bytes), size)});
}

int i2c_read(int bus, std::uint16_t address, std::string_view first_register, char* bytes, std::size_t size) {
    return transfer(bus,
                    std::array{message(address, 0, const_cast<char*>(first_register.data()), first_register.size()),
                               message(address, I2C_M_RD, bytes, size)});
}

}  // namespace nezumi::hw
