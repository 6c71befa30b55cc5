// A rename is the one step that a file system does whole.
#include "engine/base/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace nezumi {
namespace {

namespace fs = std::filesystem;

// All return an errno, 0 when it is done.

int write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(file, text.data(), text.size());
        if (written < 0 && errno != EINTR) return errno;
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

int write_into(const fs::path& file, std::string_view text, int flags, mode_t mode) {
    const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, mode);
    if (out < 0) return errno;
    const int problem = write_all(out, text);
    return close(out) != 0 && problem == 0 ? errno : problem;
}

int write_beside(const fs::path& file, std::string_view text) {
    std::error_code none;
    const fs::path real = fs::canonical(file, none);
    const std::string target = none ? file.string() : real.string();
    struct stat before {};
    const bool existed = stat(target.c_str(), &before) == 0;
    if (existed && !S_ISREG(before.st_mode)) return write_into(target, text, 0, 0);
    if (existed && access(target.c_str(), W_OK) != 0) return errno;

    const std::string fresh = target + ".new";
    int problem = write_into(fresh, text, O_TRUNC, existed ? before.st_mode & 0777 : 0666);
    if (problem == 0 && std::rename(fresh.c_str(), target.c_str()) != 0) problem = errno;
    if (problem != 0) unlink(fresh.c_str());
    return problem;
}

}  // namespace

Expected<void> write_whole(const fs::path& file, std::string_view text) {
    const int problem = write_beside(file, text);
    if (problem == 0) return {};
    return failure(std::string("can't be written: ") + std::strerror(problem), {.file = file.string()});
}

}  // namespace nezumi
