// Uses renames, so that a complete file exists at every moment.
#include "engine/base/result_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "engine/base/csv.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {
namespace {

constexpr int most_set_aside = 99;

// Renames the file to an unused name. Returns "" on failure, for example in a folder without write permission.
std::string rename_aside(const std::string& path) {
    for (int number = 1; number <= most_set_aside; ++number) {
        std::string name = path + (number == 1 ? "~" : fmt::format("~{}", number));
        if (renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0) return name;
        if (errno != EEXIST) return "";
    }
    return "";
}

}  // namespace

Expected<ResultFile> ResultFile::open(const std::string& file) {
    ResultFile result;
    const auto opened = open_to_write(file);
    if (!opened) return Unexpected(opened.error());
    result.descriptor_ = *opened;
    struct stat status {};
    if (fstat(result.descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return result;
    std::error_code none;
    result.path_ = std::filesystem::canonical(file, none);
    if (status.st_size == 0) return result;

    result.set_aside_ = rename_aside(result.path_);
    int fresh = -1;
    if (!result.set_aside_.empty())
        fresh = ::open(result.path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, status.st_mode & 0777);
    if (fresh >= 0) {
        ::close(std::exchange(result.descriptor_, fresh));
        return result;
    }
    // If no new file can be made beside the older one, the older one is emptied.
    if (!result.set_aside_.empty()) std::rename(result.set_aside_.c_str(), result.path_.c_str());
    result.set_aside_.clear();
    if (ftruncate(result.descriptor_, 0) == 0) return result;
    const int problem = errno;
    ::close(result.descriptor_);
    return failure(fmt::format("can't be written: {}", std::strerror(problem)), {.file = file});
}

std::string ResultFile::told_of_older() const {
    return set_aside_.empty() ? "" : ", and the previous file is now " + set_aside_;
}

void ResultFile::replace_older() {
    if (!set_aside_.empty()) unlink(std::exchange(set_aside_, {}).c_str());
}

void ResultFile::discard() {
    if (path_.empty()) return;
    if (set_aside_.empty()) {
        unlink(path_.c_str());
    } else {
        std::rename(std::exchange(set_aside_, {}).c_str(), path_.c_str());
    }
}

void ResultFile::cut_to(std::uint64_t bytes) {
    if (!path_.empty()) static_cast<void>(truncate(path_.c_str(), static_cast<off_t>(bytes)) == 0);
}

void ResultFile::cut_to_rows(std::uint64_t from, std::string_view note) {
    if (path_.empty()) return;
    const int file = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
    struct stat status {};
    if (file < 0 || fstat(file, &status) != 0) {
        if (file >= 0) ::close(file);
        return;
    }
    const auto size = static_cast<std::uint64_t>(status.st_size);
    from = std::min(from, size);
    std::string tail(static_cast<std::size_t>(size - from), '\0');
    const ssize_t got = pread(file, tail.data(), tail.size(), static_cast<off_t>(from));
    tail.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));

    // The end of the last row, and of the last row after which the note fits into the space already allocated.
    std::uint64_t whole = from;
    std::uint64_t with_note = from;
    while (const auto end_of_row = end_of_csv_row(tail, static_cast<std::size_t>(whole - from))) {
        whole = from + *end_of_row;
        if (whole + note.size() <= size) with_note = whole;
    }
    // Tries to write the note after the last row first: if the disk has space again, the note replaces no row.
    const auto put = [&](std::uint64_t place) {
        return pwrite(file, note.data(), note.size(), static_cast<off_t>(place)) == static_cast<ssize_t>(note.size());
    };
    std::uint64_t end = whole;
    if (put(whole)) {
        end = whole + note.size();
    } else if (with_note + note.size() <= size && put(with_note)) {
        end = with_note + note.size();
    }
    static_cast<void>(ftruncate(file, static_cast<off_t>(end)) == 0);
    ::close(file);
}

}  // namespace nezumi
