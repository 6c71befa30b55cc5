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

/// Notes a run while it is repeated. If the run went back in time, only the branch at its end is kept; if it was
/// restarted, only the part after the last start.
class LightRun {
public:
    /// A value with more numbers is left out. If there are more rays, all rays are left out.
    static constexpr std::size_t most_numbers = 64, most_rays = 32;

    /// Simulated time between two frames [s], at least.
    static constexpr double period = 0.04;

    /// The arguments must outlive this object.
    LightRun(RunningSystem& live, const ClockControl& clock);

    void log(const LogLine& line);
    /// Call this after the start, and after each tick and act.
    void note();
    /// The run as text for recorded_run.js, with one of `step` frames. Call this at the end of the run.
    std::string text(const std::string& version, std::size_t step);
    std::size_t frames() const { return times_.size(); }
    /// How many numbers were noted.
    std::size_t numbers() const { return numbers_; }

private:
    // The history of one robot, thing or value: each row has the number of a frame, and the numbers from this frame on.
    struct Track {
        std::vector<std::string> leaves;  // paths of the numbers; empty for poses
        std::vector<std::pair<std::size_t, std::vector<double>>> rows;

        /// Adds a row if the numbers have changed. Returns whether they have.
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
    std::vector<double> times_;                                 // times of the frames [s]
    std::vector<std::pair<std::size_t, std::string>> systems_;  // descriptions of the system, each with its first frame
    std::vector<LogLine> lines_;
    std::vector<std::pair<std::string, const Port*>> ports_;
    std::vector<Channel> members_;
    std::size_t numbers_ = 0;                     // count of numbers in all rows
    std::map<std::string, std::size_t> touched_;  // the names of what robots touch, with numbers from 1
    Tracks robots_, things_, markers_, rays_, values_;
};

}  // namespace nezumi::web
