// A bound socket in the abstract namespace: it needs no file, and vanishes with the last process that holds it.
#include "hw/guard/lease.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "hw/device/node.hpp"
#include "hw/log/device_log.hpp"

namespace nezumi::hw {
namespace {

// True for device nodes of the kernel, false for plain files that replace them.
bool is_of_kernel(const std::string& node) {
    struct stat status {};
    struct statfs system {};
    return (stat(node.c_str(), &status) == 0 && S_ISCHR(status.st_mode)) ||
           (statfs(node.c_str(), &system) == 0 && system.f_type == SYSFS_MAGIC);
}

struct Address {
    sockaddr_un name{};
    socklen_t size = 0;

    explicit Address(const std::string& robot) {
        name.sun_family = AF_UNIX;
        // The first byte is zero: this puts the name into the abstract namespace, without a file.
        const std::size_t length = std::min(robot.size(), sizeof name.sun_path - 1);
        std::copy_n(robot.data(), length, name.sun_path + 1);
        size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
    }
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&name); }
};

// The process that holds the lease; 0 if unknown, for example in another container.
pid_t holder(const Address& address) {
    const int file = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    ucred other{};
    socklen_t size = sizeof other;
    const bool is_known = file >= 0 && connect(file, address.get(), address.size) == 0 &&
                          getsockopt(file, SOL_SOCKET, SO_PEERCRED, &other, &size) == 0;
    if (file >= 0) close(file);
    return is_known ? other.pid : 0;
}

}  // namespace

Expected<Lease> Lease::take(const std::string& driver, const std::string& node) {
    std::error_code error;
    const std::string place = std::filesystem::canonical(node, error).string();
    if (error) return failure(describe(NodeError{node, error.value()}));
    const Address address("nezumi " + driver + (is_of_kernel(node) ? "" : " " + fingerprint(place)));
    Lease lease(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const bool is_bound = lease.file_ >= 0 && bind(lease.file_, address.get(), address.size) == 0;
    // Listens so that a second program can ask for the holder's process.
    if (is_bound && listen(lease.file_, SOMAXCONN) == 0) return lease;
    if (errno != EADDRINUSE) return failure(describe(NodeError{node, errno}));
    const pid_t process = holder(address);
    if (process == getpid())
        return failure(
            fmt::format("{}: another robot of this system drives these motors already: only one of them can "
                        "be real, for example by --hw=NAME",
                        node));
    return failure(fmt::format("{}: another program{} drives this robot's motors: end it first, then try again", node,
                               process == 0 ? "" : fmt::format(" (process {})", process)));
}

Expected<Lease> Lease::of_nothing() {
    Lease lease(open("/dev/null", O_RDONLY | O_CLOEXEC));
    if (lease.file_ < 0) return failure(describe(NodeError{"/dev/null", errno}));
    return lease;
}

Lease::~Lease() {
    if (file_ >= 0) close(file_);
}

}  // namespace nezumi::hw
