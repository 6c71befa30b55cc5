// What a run says on standard error: log lines, and on a terminal a status line below them, which no line tears.
#pragma once

#include <condition_variable>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/log.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::cli {

class Screen {
public:
    /// `live`: standard error is a terminal with a status line. Then a thread of its own writes, so that a terminal
    /// that is slow or stopped (Ctrl-S) delays no tick; otherwise lines are written where they are said.
    explicit Screen(bool live);
    /// Waits until all is written, and takes the status line away.
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    void log(const LogLine& line);
    /// One line of our own.
    void say(const std::string& text);
    /// The status line from now on, so many columns wide: at most `width()` - 1.
    void show_status(std::string line, int columns);

    bool is_live() const { return live_; }
    /// Columns of the terminal.
    static int width();

private:
    void put(std::string line);
    void write_all();

    // Somebody who logs faster than the terminal scrolls loses lines, and is told how many.
    static constexpr std::size_t most_waiting = 10000;

    bool live_;
    Mutex mutex_;  // of all below
    std::condition_variable news_;
    std::vector<std::string> waiting_;
    std::size_t lost_ = 0;
    std::string status_;
    int status_columns_ = 0;
    bool status_is_new_ = false;
    bool ends_ = false;
    std::thread writer_;
};

}  // namespace nezumi::cli
