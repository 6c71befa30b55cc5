// Replaces a file by a rename, because only a rename is atomic. Opens files without blocking, because a FIFO can block.
#include "engine/base/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "engine/base/descriptor.hpp"
#include "engine/base/staged_file.hpp"

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

Error can_not_write(const fs::path& file, int problem) {
    return {std::string("can't be written: ") + std::strerror(problem), {.file = file.string()}};
}

// Keeps `file` under the name `kept` too: by a second link, which needs no disk space, or else by a copy.
Expected<void> keep_as(const std::string& kept, const std::string& file) {
    const std::string fresh = kept + ".new";
    std::error_code problem;
    fs::remove(fresh, problem);
    fs::create_hard_link(file, fresh, problem);
    if (problem) fs::copy_file(file, fresh, problem);
    if (!problem) fs::rename(fresh, kept, problem);
    if (!problem) return {};
    std::error_code none;
    fs::remove(fresh, none);
    return failure(fmt::format("can't be kept as {}: {}", kept, problem.message()), {.file = file});
}

// Writes into a device or a pipe.
Expected<void> write_into(const fs::path& file, std::string_view text) {
    const auto out = open_to_write(file);
    if (!out) return Unexpected(out.error());
    int problem = write_all(*out, text);
    if (close(*out) != 0 && problem == 0) problem = errno;
    if (problem != 0) return Unexpected(can_not_write(file, problem));
    return {};
}

}  // namespace

int write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(file, text.data(), text.size());
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
        if (written >= 0 || errno == EINTR) continue;
        if (errno != EAGAIN) return errno;
        pollfd full{
            .fd = file, .events = POLLOUT, .revents = 0};  // another process that shares it has made it non-blocking
        poll(&full, 1, -1);
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
    // Opening a device may already have an effect. The file may be replaced before it is open, so it is checked again.
    if (const auto what = other_than_file(file); !what.empty()) return expected_a_file(what);
    const Descriptor in(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat status {};
    if (!in || fstat(in.get(), &status) != 0) return refuse_with(errno);
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

Expected<int> open_to_write(const fs::path& file) {
    // Does not wait for the reader of a pipe, which may never come.
    const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
    if (out < 0 && errno == ENXIO && other_than_file(file) == "a FIFO")
        return failure("is a pipe without a reader: start its reader first, or give a file", {.file = file.string()});
    if (out < 0) return Unexpected(can_not_write(file, errno));
    fcntl(out, F_SETFL, fcntl(out, F_GETFL) & ~O_NONBLOCK);
    return out;
}

Expected<void> write_whole(const fs::path& file, std::string_view text, const std::string& kept) {
    std::error_code none;
    const fs::path real = fs::canonical(file, none);
    const std::string target = none ? file.string() : real.string();
    struct stat before {};
    const bool existed = stat(target.c_str(), &before) == 0;
    if (existed && !S_ISREG(before.st_mode)) return write_into(file, text);
    if (existed && access(target.c_str(), W_OK) != 0) return Unexpected(can_not_write(file, errno));

    StagedFile staged(target, existed ? before.st_mode & 0777 : 0666);
    int problem = staged.problem();
    if (problem == 0) problem = write_all(staged.descriptor(), text);
    if (problem == 0 && existed && !kept.empty()) {
        if (auto ok = keep_as(kept, target); !ok) return ok;
    }
    if (problem == 0) problem = staged.commit();
    if (problem != 0) return Unexpected(can_not_write(file, problem));
    return {};
}

}  // namespace nezumi
