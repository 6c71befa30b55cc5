// Reads and writes of device files, as their drivers want them.
#include "hw/device/node.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace nezumi::hw {

std::string describe(const NodeError& error) {
    std::string reason = std::generic_category().message(error.code);
    if (!reason.empty()) reason.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(reason.front())));
    return error.path + ": " + reason;
}

Node::Node(Node&& other) noexcept
    : path_(std::move(other.path_)),
      access_(other.access_),
      file_(std::exchange(other.file_, -1)),
      is_plain_(other.is_plain_) {}

tl::unexpected<NodeError> Node::failed(int code) {
    close();
    return tl::unexpected(NodeError{path_, code});
}

tl::expected<void, NodeError> Node::open() {
    if (file_ >= 0) return {};
    do {
        file_ = ::open(path_.c_str(), (access_ == Access::read ? O_RDONLY : O_WRONLY) | O_CLOEXEC | O_NOCTTY);
    } while (file_ < 0 && errno == EINTR);
    if (file_ < 0) return failed(errno);
    struct stat status {};
    if (fstat(file_, &status) != 0) return failed(errno);
    if (S_ISDIR(status.st_mode)) return failed(EISDIR);
    is_plain_ = S_ISREG(status.st_mode);
    return {};
}

void Node::close() {
    if (file_ >= 0) ::close(std::exchange(file_, -1));
}

tl::expected<std::string_view, NodeError> Node::read() {
    // Opening a node anew for each reading floods some drivers' log. One that can't be read twice from its beginning
    // says so by an end of file or an error, and is opened again.
    for (const bool again : {false, true}) {
        const bool was_open = file_ >= 0;
        if (auto ok = open(); !ok) return tl::unexpected(ok.error());
        ssize_t length = 0;
        do {
            length = pread(file_, buffer_, sizeof buffer_ - 1, 0);
        } while (length < 0 && errno == EINTR);
        if (length > 0) return std::string_view(buffer_, static_cast<std::size_t>(length));
        const int code = length < 0 ? errno : EIO;
        const bool may_be_seeking = length == 0 || code == ESPIPE || code == EINVAL;
        if (again || !was_open || !may_be_seeking) return failed(code);
        close();
    }
    return failed(EIO);
}

tl::expected<void, NodeError> Node::write(std::string_view text) {
    if (auto ok = open(); !ok) return ok;
    if (is_plain_ && ftruncate(file_, 0) != 0) return failed(errno);
    ssize_t length = 0;
    do {
        length = is_plain_ ? pwrite(file_, text.data(), text.size(), 0) : ::write(file_, text.data(), text.size());
    } while (length < 0 && errno == EINTR);
    if (length < 0) return failed(errno);
    if (static_cast<std::size_t>(length) != text.size()) return failed(EIO);
    return {};
}

}  // namespace nezumi::hw
