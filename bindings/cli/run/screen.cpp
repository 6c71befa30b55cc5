// The status line is removed before log lines are written and drawn again after them, in one write.
#include "bindings/cli/run/screen.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <utility>

#include "engine/base/thread.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

// Removes a line with `columns` columns: a terminal that has become narrower has wrapped it.
std::string take_away(int columns) {
    const int more_lines = columns > 0 ? (columns - 1) / Screen::width() : 0;
    return more_lines > 0 ? fmt::format("\r\x1b[{}A\x1b[J", more_lines) : "\r\x1b[J";
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

Screen::Screen(bool live) : live_(live), writer_(start_thread([this] { write_all(); })) {}

Screen::~Screen() {
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
    // `visible_message` escapes control sequences in a script's text.
    put(fmt::format("{}[{:9.3f}] {:5} {}{}{}\n", colour, line.seconds, to_text(line.level), who,
                    visible_message(line.text), colour.empty() ? "" : "\x1b[0m"));
}

void Screen::say(const std::string& text) { put(visible(text) + "\n"); }

void Screen::put(std::string_view lines) {
    {
        const std::lock_guard lock(mutex_);
        if (waiting_bytes_ > most_waiting || lost_ > 0) {
            ++lost_;
            return;
        }
        waiting_ += lines;
        waiting_bytes_ += lines.size();
    }
    news_.notify_one();
}

void Screen::flush(std::chrono::milliseconds patience) {
    Lock lock(mutex_);
    written_.wait_for(lock, patience, [this] { return waiting_bytes_ == 0 && lost_ == 0; });
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
        news_.wait(lock, [this] { return ends_ || status_is_new_ || !waiting_.empty() || lost_ > 0; });
        ends = ends_;
        status_is_new_ = false;
        std::string text = live_ ? take_away(std::exchange(shown_columns, status_columns_)) : "";
        const std::size_t bytes = waiting_.size();
        text += std::exchange(waiting_, {});
        if (const std::size_t lost = std::exchange(lost_, 0); lost > 0)
            text += fmt::format("({} more lines were dropped, because they came too fast)\n", lost);
        if (!ends) text += status_;
        lock.unlock();
        nezumi::write_all(STDERR_FILENO, text);  // an error here can't be reported
        lock.lock();
        waiting_bytes_ -= bytes;
        written_.notify_all();
    }
}

}  // namespace nezumi::cli
