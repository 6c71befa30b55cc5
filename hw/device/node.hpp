// A device's file: kept open, every return value looked at.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

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
    enum class Access { read, write };

    Node(std::string path, Access access) : path_(std::move(path)), access_(access) {}
    ~Node() { close(); }
    Node(Node&& other) noexcept;
    Node& operator=(Node&&) = delete;

    tl::expected<void, NodeError> open();
    void close();
    /// What it says, from its beginning: at most 255 bytes, good until the next call.
    tl::expected<std::string_view, NodeError> read();
    /// Writes all of the text at once. A device that took less of it failed (EIO).
    tl::expected<void, NodeError> write(std::string_view text);

    const std::string& path() const { return path_; }

private:
    tl::unexpected<NodeError> failed(int code);

    std::string path_;
    Access access_;
    int file_ = -1;
    bool is_plain_ = false;
    char buffer_[256]{};  // some drivers write past a buffer of less than 64 bytes
};

}  // namespace nezumi::hw
