// A writer locks the file, then checks that the name still refers to the locked file.
#include "bindings/terminal/input_history.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/base/descriptor.hpp"
#include "engine/base/state_folder.hpp"

namespace nezumi {
namespace {

std::string encode(std::string_view input) {
    std::string line;
    for (const char letter : input) {
        if (letter == '\\') {
            line += "\\\\";
        } else if (letter == '\n') {
            line += "\\n";
        } else {
            line += letter;
        }
    }
    return line + "\n";
}

std::string decode_line(std::string_view line) {
    std::string input;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const bool escaped = line[at] == '\\' && at + 1 < line.size();
        if (escaped) ++at;
        input += escaped && line[at] == 'n' ? '\n' : line[at];
    }
    return input;
}

Descriptor open_locked(const std::filesystem::path& path, int flags) {
    for (;;) {
        Descriptor file(open(path.c_str(), flags | O_CLOEXEC, 0600));
        struct stat locked {};
        if (!file || flock(file.get(), LOCK_EX) != 0 || fstat(file.get(), &locked) != 0) return Descriptor();
        // Another console may have replaced the file by a shorter one before the lock: then the locked file has no name
        // any more, and is opened again.
        if (locked.st_nlink > 0) return file;
    }
}

std::string read_all(const Descriptor& file) {
    std::string text;
    std::array<char, 65536> piece{};
    for (;;) {
        const ssize_t got = ::read(file.get(), piece.data(), piece.size());
        if (got <= 0) return text;
        text.append(piece.data(), static_cast<std::size_t>(got));
    }
}

bool write_all(const Descriptor& file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(file.get(), text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (end > 0) lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

// Replaces a long file by one with the latest lines. On an error the old lines stay.
void cut_down(const std::filesystem::path& path, const std::vector<std::string_view>& lines) {
    std::string text;
    for (std::size_t at = lines.size() - HistoryFile::kept; at < lines.size(); ++at)
        text.append(lines[at]).append("\n");
    std::filesystem::path shorter = path;
    shorter += ".new";
    const Descriptor file(open(shorter.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
    if (file && write_all(file, text)) rename(shorter.c_str(), path.c_str());
}

}  // namespace

std::filesystem::path history_path() {
    const std::filesystem::path folder = state_folder();
    return folder.empty() ? folder : folder / "history";
}

std::vector<std::string> HistoryFile::read() const {
    std::vector<std::string> inputs;
    if (path_.empty()) return inputs;
    const Descriptor file = open_locked(path_, O_RDONLY);
    if (!file) return inputs;
    const std::string text = read_all(file);
    const std::vector<std::string_view> lines = lines_of(text);
    if (lines.size() > 2 * kept) cut_down(path_, lines);
    inputs.reserve(lines.size());
    for (const std::string_view line : lines) inputs.push_back(decode_line(line));
    return inputs;
}

Expected<void> HistoryFile::append(std::string_view input) const {
    if (path_.empty()) return {};
    const auto failed = [this] {
        return failure("can't keep the history in " + path_.string() + ": " + std::strerror(errno));
    };
    const std::filesystem::path folder = path_.parent_path();
    std::error_code error;
    std::filesystem::create_directories(folder.parent_path(), error);
    if (!error && mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return failed();
    const Descriptor file = open_locked(path_, O_RDWR | O_APPEND | O_CREAT);
    if (!file) return failed();
    // A file written by another program, or truncated by a full disk, may end within a line.
    char last = '\n';
    if (const off_t size = lseek(file.get(), 0, SEEK_END); size > 0) {
        if (pread(file.get(), &last, 1, size - 1) != 1) return failed();
    }
    if (!write_all(file, (last == '\n' ? "" : "\n") + encode(input))) return failed();
    return {};
}

}  // namespace nezumi
