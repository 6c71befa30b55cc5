// Checks a device node before opening it.
#include "hw/wire/wire_node.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cerrno>
#include <filesystem>

#include "hw/device/node.hpp"

namespace nezumi::hw {
namespace {

// The kernel's name of the subsystem of a character device.
std::string subsystem_of(dev_t device, const DeviceRoots& roots) {
    std::error_code none;
    const auto link = fmt::format("{}/dev/char/{}:{}/subsystem", roots.sys, major(device), minor(device));
    return std::filesystem::read_symlink(link, none).filename().string();
}

// The kernel module that must be loaded so that this node exists; "": unknown.
std::string missing_module(const std::string& path, const DeviceRoots& roots, const NodeKind& kind) {
    const std::string name = std::filesystem::path(path).filename().string();
    std::error_code none;
    if (kind.module.empty() || !name.starts_with(kind.node)) return "";
    const auto adapter = fmt::format("{}/{}{}", roots.sys, kind.adapter, name.substr(kind.node.size()));
    return std::filesystem::exists(adapter, none) ? kind.module : "";
}

class PlainWire final : public OpenWire {
public:
    explicit PlainWire(Descriptor file) : file_(std::move(file)) {}

    tl::expected<double, int> read(std::vector<Arrived>& /*arrived*/) override { return 0.5; }
    WriteTarget target() const override { return {.by = WriteBy::plain, .file = file_.get()}; }

private:
    Descriptor file_;
};

}  // namespace

std::string WireDriver::why_lost(int error) const {
    return error == 0 ? "it was unplugged" : describe(NodeError{"it", error});
}

std::string with_wire_advice(const std::string& path, int error, const NodeKind& kind) {
    std::string text = describe(NodeError{path, error});
    if (error == EACCES)
        text += fmt::format(": add this user to the group {0}: sudo adduser $USER {0}, then log in again", kind.group);
    if (error == ENOENT) text += ": " + kind.when_missing;
    return text;
}

std::string not_of_kind(const std::string& path, const NodeKind& kind) {
    return fmt::format("{}: it is not {}: expected a device such as {}", path, kind.what, kind.example);
}

OrWhy<WireNode> open_node(const std::string& path, const DeviceRoots& roots, const NodeKind& kind) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        const int error = errno;
        const std::string module = error == ENOENT ? missing_module(path, roots, kind) : "";
        if (module.empty()) return tl::unexpected(with_wire_advice(path, error, kind));
        return tl::unexpected(fmt::format("{0}: the module {1} is not loaded: sudo modprobe {1}", path, module));
    }
    const bool may_be_plain = roots.dev != "/dev" && path.starts_with(roots.dev + "/");
    const bool is_plain = S_ISREG(status.st_mode) && may_be_plain;
    const bool is_of_kind =
        S_ISCHR(status.st_mode) && (kind.subsystem.empty() || subsystem_of(status.st_rdev, roots) == kind.subsystem);
    if (!is_plain && !is_of_kind) return tl::unexpected(not_of_kind(path, kind));
    Descriptor file(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (file.get() < 0) return tl::unexpected(with_wire_advice(path, errno, kind));
    return WireNode{std::move(file), is_plain};
}

std::unique_ptr<OpenWire> plain_wire(Descriptor file) { return std::make_unique<PlainWire>(std::move(file)); }

}  // namespace nezumi::hw
