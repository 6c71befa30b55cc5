// An eventfd and poll.
#include "hw/device/wake.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <system_error>

namespace nezumi::hw {

Wake::Wake() : bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (bell_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Wake::~Wake() { close(bell_); }

void Wake::ring() const {
    const std::uint64_t one = 1;
    // The write fails only after 2^64 calls.
    [[maybe_unused]] const ssize_t written = write(bell_, &one, sizeof one);
}

void Wake::wait(double seconds, int file) const {
    std::array<pollfd, 2> files{pollfd{.fd = bell_, .events = POLLIN, .revents = 0},
                                pollfd{.fd = file, .events = POLLIN, .revents = 0}};
    const double time = std::clamp(seconds, 0.0, 1e6);
    const timespec timeout{.tv_sec = static_cast<time_t>(time),
                           .tv_nsec = static_cast<long>((time - static_cast<double>(static_cast<time_t>(time))) * 1e9)};
    ppoll(files.data(), files.size(), &timeout, nullptr);
    std::uint64_t rung = 0;
    [[maybe_unused]] const ssize_t length = read(bell_, &rung, sizeof rung);
}

}  // namespace nezumi::hw
