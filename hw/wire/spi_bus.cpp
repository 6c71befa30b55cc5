// SPI_IOC_MESSAGE with one transfer.
#include "hw/wire/spi_bus.hpp"

#include <linux/spi/spidev.h>
#include <sys/ioctl.h>

#include <cerrno>

namespace nezumi::hw {

int spi_set_up(int file, std::uint8_t mode, std::uint32_t speed) {
    std::uint8_t bits = 8;
    const bool works = ioctl(file, SPI_IOC_WR_MODE, &mode) >= 0 && ioctl(file, SPI_IOC_WR_BITS_PER_WORD, &bits) >= 0 &&
                       ioctl(file, SPI_IOC_WR_MAX_SPEED_HZ, &speed) >= 0;
    return works ? 0 : errno;
}

int spi_transfer(int file, const char* sent, char* received, std::size_t size) {
    spi_ioc_transfer transfer{};
    transfer.tx_buf = reinterpret_cast<std::uintptr_t>(sent);
    transfer.rx_buf = reinterpret_cast<std::uintptr_t>(received);
    transfer.len = static_cast<std::uint32_t>(size);
    return ioctl(file, SPI_IOC_MESSAGE(1), &transfer) < 0 ? errno : 0;
}

}  // namespace nezumi::hw
