// A past run as numbers that a page shows without an engine: where everything was, and the values of ports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings/web/state_reader.hpp"
#include "engine/base/log.hpp"
#include "engine/live/running_system.hpp"
#include "engine/trace/channel.hpp"

namespace nezumi::web {

/// Notes a run while it is repeated. Of a run that went back in time it keeps the branch at its end, and of one that
/// was restarted the last start.
class LightRun {
public:
    /// Values with more numbers are left out, and so are rays if there are more.
    static constexpr std::size_t most_numbers = 64, most_rays = 32;

    /// Simulated time between two frames [s], at least.
    static constexpr double period = 0.04;

    /// The arguments must outlive this object.
    LightRun(RunningSystem& live, const ClockControl& clock);

    void log(const LogLine& line);
    /// Call this after the start, and after each tick and act.
    void note();
    /// One of `step` frames, as recorded_run.js reads them. Call this at the end of the run.
    std::string text(const std::string& version, std::size_t step);
    std::size_t frames() const { return times_.size(); }
    /// How many numbers were noted.
    std::size_t numbers() const { return numbers_; }

private:
    // What was seen of one thing: rows with the number of a frame, and what it was from then on.
    struct Track {
        std::vector<std::string> leaves;  // their paths; empty for poses
        std::vector<std::pair<std::size_t, std::vector<double>>> rows;

        /// Returns whether it has changed.
        bool add(std::size_t frame, std::vector<double> numbers);
        void cut(std::size_t frame);
    };
    using Tracks = std::map<std::string, Track>;

    void go_back(double seconds);
    void look_for_names();
    void note_values(std::size_t frame);
    void note_world(std::size_t frame);

    RunningSystem& live_;
    StateReader reader_;
    int starts_ = 0;
    int generation_ = -1;
    std::uint64_t layout_ = 0;
    std::uint64_t fingerprint_ = 0;
    bool with_rays_ = true;
    std::vector<double> times_;                                 // of the frames
    std::vector<std::pair<std::size_t, std::string>> systems_;  // their descriptions
    std::vector<LogLine> lines_;
    std::vector<std::pair<std::string, const Port*>> ports_;
    std::vector<Channel> members_;
    std::size_t numbers_ = 0;                     // in all rows
    std::map<std::string, std::size_t> touched_;  // what robots touch, by name: its number from 1
    Tracks robots_, things_, markers_, rays_, values_;
};

}  // namespace nezumi::web
