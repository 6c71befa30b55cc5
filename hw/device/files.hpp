// The files of devices as drivers reach them: the kernel's own, unless they are logged or played back.
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

/// What a system call gave, or its `errno`.
template <class T>
using Answer = tl::expected<T, int>;

/// A file that is open, until this goes.
class OpenFile {
public:
    virtual ~OpenFile() = default;
    /// Reads from its beginning: how many bytes.
    virtual Answer<std::size_t> read(std::span<char> buffer) = 0;
    /// Writes all of it at once, a plain file's content: how many bytes it took.
    virtual Answer<std::size_t> write(std::string_view text) = 0;
    /// Which keys of an event device are down, a bit each (EVIOCGKEY): how many bytes.
    virtual Answer<std::size_t> keys(std::span<char> down) = 0;
    /// The kernel's number of it; -1: there is no device behind it.
    virtual int descriptor() const { return -1; }
};

/// Any call may come from any thread, and may wait for a device.
class DeviceFiles {
public:
    virtual ~DeviceFiles() = default;
    virtual Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) = 0;
    /// The names in a folder, in its order.
    virtual Answer<std::vector<std::string>> list(const std::string& folder) = 0;
    /// Whether there are devices behind them: motors that a guard has to stop, and that one program at a time drives.
    virtual bool are_real() const { return true; }
};

std::shared_ptr<DeviceFiles> kernel_files();

/// Where a file is, and through what it is reached.
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
    std::shared_ptr<DeviceFiles> files_;  // shared with threads that a device has never let go
};

}  // namespace nezumi::hw
