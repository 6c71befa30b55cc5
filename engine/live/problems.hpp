// Stores the latest warnings and errors of a run.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "engine/base/list.hpp"
#include "engine/base/log.hpp"

namespace nezumi {

class Problems {
public:
    /// Maximum number of lines.
    static constexpr std::size_t most_lines = 100;

    /// Stores a warning or an error if it is new. A repeated past logs its lines again; these are not stored again.
    void take(const LogLine& line) {
        if (line.level != LogLevel::warn && line.level != LogLevel::error) return;
        if (contains(lines_, line)) return;
        if (lines_.size() == most_lines) lines_.pop_front();
        lines_.push_back(line);
    }
    /// The stored lines, oldest first.
    std::vector<LogLine> lines() const { return {lines_.begin(), lines_.end()}; }

private:
    std::deque<LogLine> lines_;
};

}  // namespace nezumi
