// The status line is taken away before a log line is written and comes back after it, all in one write.
#include "bindings/cli/screen.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string_view>
#include <utility>

#include "engine/base/visible.hpp"

namespace nezumi::cli {
namespace {

// Takes a line away that was so many columns wide: a terminal that has become narrower has made it several.
std::string take_away(int columns) {
    const int more_lines = columns > 0 ? (columns - 1) / Screen::width() : 0;
    return more_lines > 0 ? fmt::format("\r\x1b[{}A\x1b[J", more_lines) : "\r\x1b[J";
}

void write_whole(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;  // nobody is there to be told
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

std::string_view colour_of_level(LogLevel level) {
    switch (level) {
        case LogLevel::debug: return "\x1b[2m";
        case LogLevel::info: return "";
        case LogLevel::warn: return "\x1b[33m";
        case LogLevel::error: return "\x1b[31m";
    }
    return "";
}

}  // namespace

Screen::Screen(bool live) : live_(live) {
    if (live_) writer_ = std::thread([this] { write_all(); });
}

Screen::~Screen() {
    if (!live_) return;
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    news_.notify_one();
    writer_.join();
}

int Screen::width() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void Screen::log(const LogLine& line) {
    const std::string who = line.component.empty() ? "" : line.component + ": ";
    const std::string_view colour = live_ ? colour_of_level(line.level) : "";
    // A script's text is no way to reach the terminal itself.
    put(fmt::format("{}[{:9.3f}] {:5} {}{}{}\n", colour, line.seconds, to_text(line.level), who,
                    visible_message(line.text), colour.empty() ? "" : "\x1b[0m"));
}

void Screen::say(const std::string& text) { put(visible(text) + "\n"); }

void Screen::put(std::string line) {
    if (!live_) return write_whole(line);
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() < most_waiting) {
            waiting_.push_back(std::move(line));
        } else {
            ++lost_;
        }
    }
    news_.notify_one();
}

void Screen::show_status(std::string line, int columns) {
    if (!live_) return;
    {
        const std::lock_guard lock(mutex_);
        status_ = std::move(line);
        status_columns_ = columns;
        status_is_new_ = true;
    }
    news_.notify_one();
}

void Screen::write_all() {
    Lock lock(mutex_);
    int shown_columns = 0;
    for (bool ends = false; !ends;) {
        news_.wait(lock, [this] { return ends_ || status_is_new_ || !waiting_.empty(); });
        ends = ends_;
        status_is_new_ = false;
        std::string text = take_away(std::exchange(shown_columns, status_columns_));
        for (const std::string& line : std::exchange(waiting_, {})) text += line;
        if (const std::size_t lost = std::exchange(lost_, 0); lost > 0)
            text += fmt::format("({} more lines came faster than this terminal shows them)\n", lost);
        if (!ends) text += status_;
        lock.unlock();
        write_whole(text);
        lock.lock();
    }
}

}  // namespace nezumi::cli
