// The output of a run on standard error: log lines, and on a terminal a status line below them.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <string>
#include <string_view>
#include <thread>

#include "engine/base/log.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::cli {

/// Writes on its own thread, so a slow standard error (a terminal stopped by Ctrl-S, a pipe that is not read, a slow
/// disk) delays no tick.
class Screen {
public:
    /// `live`: standard error is a terminal with a status line.
    explicit Screen(bool live);
    /// Waits until everything is written, and removes the status line.
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    // These functions never wait. Above `most_waiting`, lines are dropped; their number is written instead.

    void log(const LogLine& line);
    /// Writes a line that is not a log line.
    void say(const std::string& text);
    /// Writes lines without changes, such as a drawing for a terminal.
    void show(std::string_view lines) { put(lines); }
    /// Sets the status line, with its width in columns: at most `width()` - 1.
    void show_status(std::string line, int columns);

    /// Waits until everything is written, but at most `patience`.
    void flush(std::chrono::milliseconds patience);
    /// True if standard error is too slow: then a run without a clock should wait.
    bool is_behind() const { return waiting_bytes_ > most_waiting / 4; }
    bool is_live() const { return live_; }
    /// Columns of the terminal.
    static int width();

    static constexpr std::size_t most_waiting = std::size_t{4} << 20;  ///< [bytes]

private:
    void put(std::string_view lines);
    void write_all();

    const bool live_;
    Mutex mutex_;  // for all members below
    std::condition_variable news_;
    std::condition_variable written_;
    std::string waiting_;
    std::atomic<std::size_t> waiting_bytes_ = 0;  // including those being written
    std::size_t lost_ = 0;                        // lines
    std::string status_;
    int status_columns_ = 0;
    bool status_is_new_ = false;
    bool ends_ = false;
    std::thread writer_;
};

}  // namespace nezumi::cli
