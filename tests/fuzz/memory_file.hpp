// A file that holds what a fuzzer gave, on no disk.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "tests/fuzz/require.hpp"

namespace nezumi {

class MemoryFile {
public:
    MemoryFile() : file_(memfd_create("input", MFD_CLOEXEC)) { require(file_ >= 0); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { close(file_); }

    void hold(const std::uint8_t* data, std::size_t size) const {
        require(ftruncate(file_, 0) == 0);
        require(pwrite(file_, data, size, 0) == static_cast<ssize_t>(size));
    }
    /// A name by which it can be opened.
    std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

private:
    int file_;
};

}  // namespace nezumi
