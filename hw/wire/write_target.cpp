// Uses only system calls, because the writer's process, a fork, may use nothing else.
#include "hw/wire/write_target.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hw/wire/gpio_lines.hpp"
#include "hw/wire/i2c_bus.hpp"
#include "hw/wire/spi_bus.hpp"

namespace nezumi::hw {
namespace {

template <class Transaction>
ssize_t write_whole(std::size_t size, const Transaction& transaction) {
    const int error = retry_transfer(transaction);
    if (error == 0) return static_cast<ssize_t>(size);
    errno = error;
    return -1;
}

}  // namespace

ssize_t write_message(const WriteTarget& target, const char* bytes, std::size_t size, char* answer) {
    switch (target.by) {
        case WriteBy::stream:
        case WriteBy::datagram: break;
        case WriteBy::plain:
            if (ftruncate(target.file, 0) != 0) return -1;
            return pwrite(target.file, bytes, size, 0);
        case WriteBy::i2c:
            return write_whole(size, [&] { return i2c_write(target.file, target.address, bytes, size); });
        case WriteBy::spi:
        case WriteBy::spi_answered:
            return write_whole(size, [&] { return spi_transfer(target.file, bytes, answer, size); });
        case WriteBy::gpio: {
            GpioLevels levels;
            std::memcpy(&levels, bytes, std::min(size, sizeof levels));
            return write_whole(size, [&] { return set_gpio(target.file, target.pwm, levels); });
        }
    }
    return write(target.file, bytes, size);
}

}  // namespace nezumi::hw
