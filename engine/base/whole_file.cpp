// A rename is the one step that a file system does whole; opening without blocking the one way to ask a FIFO what it
// is.
#include "engine/base/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "engine/base/descriptor.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

std::string_view other_than_file(mode_t mode) {
    switch (mode & S_IFMT) {
        case S_IFREG: return "";
        case S_IFDIR: return "a folder";
        case S_IFIFO: return "a FIFO";
        case S_IFSOCK: return "a socket";
        default: return "a device";
    }
}

// All return an errno, 0 when it is done.

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

int write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(file, text.data(), text.size());
        if (written < 0 && errno != EINTR) return errno;
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

std::string_view other_than_file(const fs::path& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? other_than_file(status.st_mode) : "";
}

Expected<std::string> read_whole(const fs::path& file, const std::string& shown, std::size_t largest) {
    const auto refuse = [&](std::string why) { return failure(std::move(why), {.file = shown}); };
    const auto refuse_with = [&](int code) {
        return code == ENOENT ? refuse("there is no such file")
                              : refuse(std::string("can't be read: ") + std::strerror(code));
    };
    const auto expected_a_file = [&](std::string_view what) {
        return refuse(fmt::format("is {}, expected a file", what));
    };
    // To open a device may already do something. What is there may be another thing by the time that it is open.
    if (const auto what = other_than_file(file); !what.empty()) return expected_a_file(what);
    const Descriptor in(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat status {};
    if (!in.is_open() || fstat(in.get(), &status) != 0) return refuse_with(errno);
    if (const auto what = other_than_file(status.st_mode); !what.empty()) return expected_a_file(what);
    const auto too_large = [&] { return refuse(fmt::format("is larger than {} MB", largest >> 20)); };
    if (static_cast<std::uint64_t>(status.st_size) > largest) return too_large();
    std::string text;
    text.reserve(static_cast<std::size_t>(status.st_size));
    char buffer[65536];
    for (;;) {
        const ssize_t count = read(in.get(), buffer, sizeof buffer);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return refuse_with(errno);
        if (count == 0) return text;
        text.append(buffer, static_cast<std::size_t>(count));
        if (text.size() > largest) return too_large();
    }
}

Expected<void> write_whole(const fs::path& file, std::string_view text) {
    const int problem = write_beside(file, text);
    if (problem == 0) return {};
    return failure(std::string("can't be written: ") + std::strerror(problem), {.file = file.string()});
}

}  // namespace nezumi
