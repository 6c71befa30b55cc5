// A file descriptor that is closed automatically.
#pragma once

#include <unistd.h>

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

}  // namespace nezumi
