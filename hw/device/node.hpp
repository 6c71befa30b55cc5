// A device's file: kept open, every return value looked at.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hw/device/files.hpp"

namespace nezumi::hw {

/// What the kernel answered when a node could not be used.
struct NodeError {
    std::string path;
    int code = 0;  ///< `errno`
};

/// "/dev/rtled0: no such file or directory".
std::string describe(const NodeError& error);

/// Opened when it is first used, and again after an error: a device that went is taken up when it is back. A plain file
/// in its place is truncated before each write. Not for two threads at once.
class Node {
public:
    using Access = hw::Access;

    Node(DevicePath path, Access access) : path_(std::move(path)), access_(access) {}

    tl::expected<void, NodeError> open();
    void close() { file_.reset(); }
    /// What it says, from its beginning: at most 255 bytes, good until the next call.
    tl::expected<std::string_view, NodeError> read();
    /// Writes all of the text at once. A device that took less of it failed (EIO).
    tl::expected<void, NodeError> write(std::string_view text);

    const std::string& path() const { return path_.text(); }
    /// Of the device that is open; -1: none is.
    int descriptor() const { return file_ ? file_->descriptor() : -1; }

private:
    tl::unexpected<NodeError> failed(int code);

    DevicePath path_;
    Access access_;
    std::unique_ptr<OpenFile> file_;  // null: it is not open
    char buffer_[256]{};              // some drivers write past a buffer of less than 64 bytes
};

}  // namespace nezumi::hw
