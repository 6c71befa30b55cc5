// Runs the real executable on a terminal, as a person would, and keeps what the terminal shows.
#pragma once

#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/unit/cli/run_program.hpp"

namespace nezumi {

/// As much of a terminal as a line editor needs, for ASCII: rows of text, oldest first, and a cursor.
class TerminalScreen {
public:
    explicit TerminalScreen(std::size_t columns) : columns_(columns) {}

    void take(std::string_view bytes) {
        pending_ += bytes;
        while (!pending_.empty()) {
            const std::size_t size = take_front();
            if (size == 0) return;
            pending_.erase(0, size);
        }
    }
    /// Without spaces at their ends, and without the empty ones below all.
    std::vector<std::string> rows() const {
        std::vector<std::string> rows = rows_;
        for (std::string& row : rows) row.erase(row.find_last_not_of(' ') + 1);
        while (!rows.empty() && rows.back().empty()) rows.pop_back();
        return rows;
    }
    /// What stands there stays as it is, as in xterm.
    void resize(std::size_t columns) { columns_ = columns; }
    std::string last_row() const { return rows().empty() ? "" : rows().back(); }

private:
    // Returns how much it took; 0 when more must come.
    std::size_t take_front() {
        const char first = pending_[0];
        if (first == '\x1b') return take_escape();
        if (first == '\r') {
            column_ = 0;
        } else if (first == '\n') {
            move_down();
        } else if (first == '\b') {
            if (column_ > 0) --column_;
        } else if (first == '\t') {
            column_ = std::min(columns_ - 1, column_ / 8 * 8 + 8);
        } else if (first >= ' ') {
            if (column_ == columns_) {
                column_ = 0;
                move_down();
            }
            cell() = first;
            ++column_;
        }
        return 1;
    }
    std::size_t take_escape() {
        if (pending_.size() < 2) return 0;
        if (pending_[1] == ']') {
            const std::size_t end = pending_.find('\a');
            return end == std::string::npos ? 0 : end + 1;
        }
        if (pending_[1] == '(' || pending_[1] == ')') return pending_.size() < 3 ? 0 : 3;
        if (pending_[1] != '[') return 2;
        for (std::size_t at = 2; at < pending_.size(); ++at) {
            if (pending_[at] < 0x40) continue;
            obey(pending_[at], pending_.substr(2, at - 2));
            return at + 1;
        }
        return 0;
    }
    void obey(char letter, const std::string& parameters) {
        const int given = std::atoi(parameters.c_str());
        const auto count = static_cast<std::size_t>(std::max(given, 1));
        std::string& row = current();
        switch (letter) {
            case 'A': row_ -= std::min(row_, count); break;
            case 'B': row_ += count; break;
            case 'C': column_ = std::min(columns_ - 1, column_ + count); break;
            case 'D': column_ -= std::min(column_, count); break;
            case 'G': column_ = count - 1; break;
            case 'J': rows_.resize(row_ + 1); [[fallthrough]];
            case 'K': current().resize(std::min(current().size(), column_)); break;
            case 'P': row.erase(std::min(row.size(), column_), count); break;
            case '@':
                if (column_ < row.size()) row.insert(column_, count, ' ');
                break;
            default: break;  // colours, modes, titles
        }
    }
    void move_down() { ++row_; }
    std::string& current() {
        if (rows_.size() <= row_) rows_.resize(row_ + 1);
        return rows_[row_];
    }
    char& cell() {
        std::string& row = current();
        if (row.size() <= column_) row.resize(column_ + 1, ' ');
        return row[column_];
    }

    std::size_t columns_;
    std::vector<std::string> rows_;
    std::size_t row_ = 0;
    std::size_t column_ = 0;
    std::string pending_;
};

/// Forks a process with a terminal of its own, as forkpty does. Where there are no pseudo-terminals the test is
/// skipped.
inline pid_t fork_on_terminal(int& terminal, unsigned short rows, unsigned short columns) {
    const winsize size{.ws_row = rows, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    // What ctest knows a skipped test by (discover.cmake).
    if (child < 0) throw std::runtime_error("SKIPPED: there are no pseudo-terminals here: is /dev/pts mounted?");
    return child;
}

/// A program with a terminal of so many columns.
class PtyProgram {
public:
    /// `home` is where it keeps its history and its socket. A file `input` takes the place of the terminal as standard
    /// input.
    PtyProgram(std::vector<std::string> words, const std::string& home, unsigned short columns = 80,
               const std::string& input = "")
        : screen(columns) {
        words.insert(words.begin(), nezumi_program());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        child_ = fork_on_terminal(terminal_, height, columns);
        if (child_ == 0) {
            setenv("TERM", "xterm", 1);
            setenv("XDG_STATE_HOME", home.c_str(), 1);
            setenv("XDG_RUNTIME_DIR", home.c_str(), 1);
            unsetenv("NO_COLOR");
            if (!input.empty()) dup2(open(input.c_str(), O_RDONLY), STDIN_FILENO);
            execv(pointers[0], pointers.data());
            _exit(127);
        }
        tcgetattr(terminal_, &modes_);
    }
    ~PtyProgram() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
        if (terminal_ >= 0) close(terminal_);
    }
    PtyProgram(const PtyProgram&) = delete;
    PtyProgram& operator=(const PtyProgram&) = delete;

    void type(std::string_view keys) {
        while (!keys.empty()) {
            const ssize_t written = write(terminal_, keys.data(), keys.size());
            if (written <= 0) return;
            keys.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    /// Waits until a row is exactly this, below those that were waited for before; false when it never is.
    bool wait_for_row(const std::string& row, double seconds = 30) {
        return wait_until(
            [&] {
                const auto rows = screen.rows();
                const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(std::min(seen_, rows.size()));
                const auto found = std::find(begin, rows.end(), row);
                if (found == rows.end()) return false;
                seen_ = static_cast<std::size_t>(found - rows.begin()) + 1;
                return true;
            },
            seconds);
    }
    /// Waits until the last row, where the prompt stands, is this.
    bool wait_for_prompt(const std::string& row, double seconds = 30) {
        return wait_until([&] { return screen.last_row() == row; }, seconds);
    }
    template <class Condition>
    bool wait_until(Condition condition, double seconds = 30) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (!condition()) {
            if (std::chrono::steady_clock::now() > end || !read_some()) return condition();
        }
        return true;
    }
    /// Waits for the end. Returns the exit status, or minus the signal that ended it.
    int wait() {
        wait_until([] { return false; });
        int status = 0;
        waitpid(std::exchange(child_, -1), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    /// The terminal goes away, as when its window is closed. Returns as `wait`; -SIGKILL when it does not end by
    /// itself.
    int hang_up() {
        close(std::exchange(terminal_, -1));
        int status = 0;
        for (int tries = 0; tries < 300 && waitpid(child_, &status, WNOHANG) == 0; ++tries) usleep(100'000);
        if (kill(child_, 0) == 0) return -SIGKILL;
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    /// The terminal takes no output any more, as after Ctrl-S.
    void stop_output() const {
        const int other_end = open(ptsname(terminal_), O_RDWR | O_NOCTTY | O_CLOEXEC);
        tcflow(other_end, TCOOFF);
        close(other_end);
    }
    void send(int signal) const { kill(child_, signal); }
    pid_t process() const { return child_; }
    /// Waits for the end for at most so many seconds, and shows nothing meanwhile. Returns as `wait`; nothing when it
    /// goes on.
    std::optional<int> wait_unread(double seconds) { return end_within(child_, seconds); }
    /// The window gets another width.
    void resize(unsigned short columns) {
        const winsize size{.ws_row = height, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
        ioctl(terminal_, TIOCSWINSZ, &size);
        screen.resize(columns);
    }
    /// Whether the terminal is as the program found it.
    bool is_as_before() const {
        termios now{};
        tcgetattr(terminal_, &now);
        return now.c_lflag == modes_.c_lflag && now.c_iflag == modes_.c_iflag && now.c_oflag == modes_.c_oflag;
    }

    TerminalScreen screen;

private:
    bool read_some() {
        pollfd file{.fd = terminal_, .events = POLLIN, .revents = 0};
        if (poll(&file, 1, 100) == 0) return true;
        std::array<char, 4096> piece{};
        const ssize_t got = read(terminal_, piece.data(), piece.size());
        if (got <= 0) return false;
        screen.take({piece.data(), static_cast<std::size_t>(got)});
        return true;
    }

    static constexpr unsigned short height = 500;  // [rows]
    int terminal_ = -1;
    pid_t child_ = -1;
    termios modes_{};
    std::size_t seen_ = 0;
};

}  // namespace nezumi
