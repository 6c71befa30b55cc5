// Reads and writes device files.
#include "hw/device/node.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace nezumi::hw {

std::string describe(const NodeError& error) {
    std::string reason = std::generic_category().message(error.code);
    if (!reason.empty()) reason.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(reason.front())));
    return error.path + ": " + reason;
}

std::string with_usb_advice(const NodeError& error, std::string_view group) {
    std::string advice = ": unplug it and plug it in again, and look at what dmesg says";
    if (error.code == EACCES || error.code == EPERM)
        advice =
            fmt::format(": this user has no permission to use it. Try: sudo adduser $USER {}, and log in again", group);
    if (error.code == ENOENT || error.code == ENODEV || error.code == ENXIO)
        advice = ": it is unplugged: plug it in again";
    return describe(error) + advice;
}

tl::unexpected<NodeError> Node::failed(int code) {
    close();
    return tl::unexpected(NodeError{path(), code});
}

tl::expected<void, NodeError> Node::open() {
    if (file_) return {};
    auto opened = path_.files().open(path(), access_);
    if (!opened) return failed(opened.error());
    file_ = std::move(*opened);
    return {};
}

tl::expected<std::string_view, NodeError> Node::read() {
    // Opening a node for each reading fills the log of some drivers. A node that can't be read twice from its beginning
    // returns end of file or an error, and is opened again.
    for (const bool again : {false, true}) {
        const bool was_open = file_ != nullptr;
        if (auto ok = open(); !ok) return tl::unexpected(ok.error());
        const auto length = file_->read({buffer_, sizeof buffer_ - 1});
        if (length && *length > 0) return std::string_view(buffer_, *length);
        const int code = length ? EIO : length.error();
        const bool may_be_seeking = length || code == ESPIPE || code == EINVAL;
        if (again || !was_open || !may_be_seeking) return failed(code);
        close();
    }
    return failed(EIO);
}

tl::expected<void, NodeError> Node::write(std::string_view text) {
    if (auto ok = open(); !ok) return ok;
    const auto length = file_->write(text);
    if (!length) return failed(length.error());
    if (*length != text.size()) return failed(EIO);
    return {};
}

}  // namespace nezumi::hw
