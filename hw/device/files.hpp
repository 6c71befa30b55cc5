// The interface through which drivers access device files: directly, with a log, or from a replayed log.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace nezumi::hw {

enum class Access { read, write };

/// The result of a system call, or its `errno`.
template <class T>
using Answer = tl::expected<T, int>;

/// An open file; the destructor closes it.
class OpenFile {
public:
    virtual ~OpenFile() = default;
    /// Reads from the beginning of the file. Returns the number of bytes.
    virtual Answer<std::size_t> read(std::span<char> buffer) = 0;
    /// Writes all of `text` in one call; for a regular file it is the whole content. Returns the number of bytes
    /// written.
    virtual Answer<std::size_t> write(std::string_view text) = 0;
    /// Gets the pressed keys of an event device, one bit each (EVIOCGKEY). Returns the number of bytes.
    virtual Answer<std::size_t> keys(std::span<char> down) = 0;
    /// The kernel's file descriptor; -1 if there is no real device.
    virtual int descriptor() const { return -1; }
};

/// Any thread may call these functions. They may block on a device.
class DeviceFiles {
public:
    virtual ~DeviceFiles() = default;
    virtual Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) = 0;
    /// The names in a folder, in its order.
    virtual Answer<std::vector<std::string>> list(const std::string& folder) = 0;
    /// True for real devices: their motors need a guard, and only one program at a time may drive them.
    virtual bool are_real() const { return true; }
};

std::shared_ptr<DeviceFiles> kernel_files();

/// The path of a device file and the access to it.
class DevicePath {
public:
    DevicePath(std::string text, std::shared_ptr<DeviceFiles> files = kernel_files())
        : text_(std::move(text)), files_(std::move(files)) {}
    DevicePath(const char* text) : DevicePath(std::string(text)) {}

    const std::string& text() const { return text_; }
    DeviceFiles& files() const { return *files_; }
    DevicePath operator+(std::string_view more) const { return {text_ + std::string(more), files_}; }

private:
    std::string text_;
    std::shared_ptr<DeviceFiles> files_;  // shared with threads that hang in a device
};

}  // namespace nezumi::hw
