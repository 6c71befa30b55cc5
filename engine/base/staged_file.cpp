// linkat does not replace a file, but rename does. So the file has a temporary name for microseconds.
#include "engine/base/staged_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace nezumi {

StagedFile::StagedFile(std::string file, mode_t mode) : file_(std::move(file)), beside_(file_ + ".new") {
    const std::string folder = std::filesystem::path(file_).parent_path().string();
    descriptor_ = open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
    if (descriptor_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == ENOTDIR)) {
        unlink(beside_.c_str());  // left by an earlier program, or a FIFO on which opening would block
        descriptor_ = open(beside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        named_ = descriptor_ >= 0;
    }
    if (descriptor_ < 0) problem_ = errno;
}

StagedFile::~StagedFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (named_) unlink(beside_.c_str());
}

int StagedFile::give_name() const {
    const std::string open_file = "/proc/self/fd/" + std::to_string(descriptor_);
    for (int tries = 0; tries < 2; ++tries) {
        if (linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, beside_.c_str(), AT_SYMLINK_FOLLOW) == 0) return 0;
        if (errno != EEXIST || unlink(beside_.c_str()) != 0) break;
    }
    return errno;
}

int StagedFile::commit() {
    if (!named_) {
        if (const int problem = give_name(); problem != 0) return problem;
        named_ = true;
    }
    if (close(std::exchange(descriptor_, -1)) != 0 || std::rename(beside_.c_str(), file_.c_str()) != 0) return errno;
    named_ = false;
    return 0;
}

}  // namespace nezumi
