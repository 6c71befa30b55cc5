// How far a session of many runs has come and how long the rest will take, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace nezumi::cli {

/// Says nothing in the first seconds: a short session needs none of it.
class SweepProgress {
public:
    using Clock = std::chrono::steady_clock;

    /// `live`: for a terminal, one line that is drawn again and again; otherwise a line each minute. The session
    /// begins.
    SweepProgress(std::function<void(std::string_view)> write, bool live, Clock::time_point now = Clock::now());

    /// So many of the runs that this session makes are over.
    void update(std::size_t done, std::size_t all, Clock::time_point now = Clock::now());
    /// Takes the line away: before other text, and at the end.
    void clear();

private:
    std::function<void(std::string_view)> write_;
    bool live_;
    bool shown_ = false;
    Clock::time_point began_;
    Clock::time_point next_;
};

/// "42 s", "3 min 20 s", "2 h 5 min".
std::string text_of_duration(double seconds);

}  // namespace nezumi::cli
