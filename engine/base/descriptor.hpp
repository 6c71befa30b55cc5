// File descriptors: a class that closes one automatically, and the number that servers leave free for other uses.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace nezumi {

class Descriptor {
public:
    Descriptor() = default;
    /// Takes ownership of an open descriptor; -1 for none.
    explicit Descriptor(int opened) : file_(opened) {}
    Descriptor(Descriptor&& other) noexcept : file_(other.release()) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        const int taken = other.release();
        close();
        file_ = taken;
        return *this;
    }
    ~Descriptor() { close(); }

    /// -1 if there is none.
    int get() const { return file_; }
    explicit operator bool() const { return file_ >= 0; }
    /// Gives the ownership of the descriptor to the caller.
    int release() { return std::exchange(file_, -1); }
    void close() {
        if (file_ >= 0) ::close(release());
    }

private:
    int file_ = -1;
};

/// Numbers of descriptors that servers leave free: for files (of robots, recordings, ...), and for files and consoles.
/// A server leaves at most an eighth, or a quarter, of the limit of the process free.
inline constexpr rlim_t for_files = 32, for_files_and_consoles = 96;

/// Whether `count` (one of the numbers above) descriptors are free after `descriptor`, which was opened last.
inline bool leaves_free(int descriptor, rlim_t count) {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return true;
    const rlim_t part = count > for_files ? 4 : 8;
    return static_cast<rlim_t>(descriptor) + std::min(count, limit.rlim_cur / part) < limit.rlim_cur;
}

}  // namespace nezumi
