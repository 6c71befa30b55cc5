// A file descriptor that is closed with its owner.
#pragma once

#include <unistd.h>

#include <utility>

namespace nezumi {

class Descriptor {
public:
    /// Takes over an open descriptor, or -1 for none.
    explicit Descriptor(int opened = -1) : file_(opened) {}
    Descriptor(Descriptor&& other) noexcept : file_(other.release()) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(file_, other.file_);
        return *this;
    }
    ~Descriptor() { close(); }

    /// -1 when there is none.
    int get() const { return file_; }
    bool is_open() const { return file_ >= 0; }
    /// The descriptor, which is the caller's from now on.
    int release() { return std::exchange(file_, -1); }
    void close() {
        if (is_open()) ::close(release());
    }

private:
    int file_;
};

}  // namespace nezumi
