// A device file that is kept open, with every return value checked.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hw/device/files.hpp"

namespace nezumi::hw {

/// The error of a device node.
struct NodeError {
    std::string path;
    int code = 0;  ///< `errno`
};

/// "/dev/rtled0: no such file or directory".
std::string describe(const NodeError& error);
/// Describes an error with what to do, for a USB device whose nodes may be used by this `group`.
std::string with_usb_advice(const NodeError& error, std::string_view group);

/// Opened at first use, and again after an error, so a device that was removed works again when it is back. A regular
/// file is truncated before each write. Not thread-safe.
class Node {
public:
    using Access = hw::Access;

    Node(DevicePath path, Access access) : path_(std::move(path)), access_(access) {}

    tl::expected<void, NodeError> open();
    void close() { file_.reset(); }
    /// Reads the node from its beginning: at most 255 bytes, valid until the next call.
    tl::expected<std::string_view, NodeError> read();
    /// Writes all of the text in one call. A shorter write is an error (EIO).
    tl::expected<void, NodeError> write(std::string_view text);

    const std::string& path() const { return path_.text(); }
    /// The descriptor of the open device; -1 if it is closed.
    int descriptor() const { return file_ ? file_->descriptor() : -1; }

private:
    tl::unexpected<NodeError> failed(int code);

    DevicePath path_;
    Access access_;
    std::unique_ptr<OpenFile> file_;  // null: closed
    char buffer_[256]{};              // 256 because some drivers write past a buffer of less than 64 bytes
};

}  // namespace nezumi::hw
