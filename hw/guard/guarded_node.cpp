// An open descriptor still works if permissions, a mount or another node change its path.
#include "hw/guard/guarded_node.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace nezumi::hw {
namespace {

// 0, or why the name of the file is gone.
int removal_of(int file) {
    struct stat status {};
    if (fstat(file, &status) != 0) return errno;
    return status.st_nlink == 0 ? ENOENT : 0;
}

bool write_text(int file, const char* text) {
    const std::size_t size = std::strlen(text);
    struct stat status {};
    const bool is_plain = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    // A regular file in place of a device contains only the last write.
    if (is_plain && ftruncate(file, 0) != 0) status = {};
    const ssize_t written = is_plain ? pwrite(file, text, size, 0) : write(file, text, size);
    return written == static_cast<ssize_t>(size);
}

}  // namespace

void take_up(GuardedNode& node, const GuardOrder::Node& what, int file) {
    if (node.file >= 0) close(node.file);
    node = {.file = file, .what = what};
}

int problem_of(const GuardedNode& node) {
    if (node.file < 0 || node.what.proof == Proof::none) return 0;
    if (node.what.proof == Proof::empty_write && write(node.file, "", 0) != 0) return errno;
    return removal_of(node.file);
}

void stop(const GuardedNode& node) {
    const char* text = node.what.text.data();
    if (write_text(node.file, text) && removal_of(node.file) == 0) return;
    const int file = open(node.what.path.data(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file < 0) return;
    write_text(file, text);
    close(file);
}

}  // namespace nezumi::hw
