// The lock is the node's own: no other file is needed, and robots under other roots have others.
#include "hw/guard/lease.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "hw/device/node.hpp"

namespace nezumi::hw {
namespace {

// The process that has it locked, as the kernel's list of locks has it: its column 5, where column 6 is
// "major:minor:inode". "": not told.
std::string holder(int file) {
    struct stat status {};
    if (fstat(file, &status) != 0) return "";
    const std::string inode =
        fmt::format("{:02x}:{:02x}:{}", major(status.st_dev), minor(status.st_dev), status.st_ino);
    std::ifstream locks("/proc/locks");
    std::string number, kind, strength, access, process, place, rest;
    while (locks >> number >> kind >> strength >> access >> process >> place && std::getline(locks, rest)) {
        if (kind == "FLOCK" && place == inode) return process;
    }
    return "";
}

}  // namespace

Expected<Lease> Lease::take(const std::string& node) {
    Lease lease(open(node.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (lease.file_ < 0 && errno == EISDIR) lease.file_ = open(node.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lease.file_ < 0) return failure(describe(NodeError{node, errno}));
    if (flock(lease.file_, LOCK_EX | LOCK_NB) == 0) return lease;
    if (errno != EWOULDBLOCK) return failure(describe(NodeError{node, errno}));
    const std::string process = holder(lease.file_);
    if (process == fmt::to_string(getpid()))
        return failure(
            fmt::format("{}: another robot of this system drives these motors already: only one of them can "
                        "be real, as by --hw=NAME",
                        node));
    return failure(fmt::format("{}: another program{} drives this robot's motors: end it first, then try again", node,
                               process.empty() ? "" : fmt::format(" (process {})", process)));
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
