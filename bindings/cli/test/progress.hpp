// The progress of a session with many runs, and its remaining time, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace nezumi::cli {

/// Writes nothing in the first seconds, because a short session does not need it.
class SweepProgress {
public:
    using Clock = std::chrono::steady_clock;

    /// `live`: for a terminal, one line that is redrawn; otherwise one line per minute. Starts the clock.
    SweepProgress(std::function<void(std::string_view)> write, bool live, Clock::time_point now = Clock::now());

    /// Sets how many of this session's runs have finished.
    void update(std::size_t done, std::size_t all, Clock::time_point now = Clock::now());
    /// Removes the line: before other output, and at the end.
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
