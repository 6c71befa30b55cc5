// A recorded run as a running system, whose ports can be looked at while time moves through the recording.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/files/recorded_topics.hpp"
#include "bindings/journal/replay.hpp"
#include "engine/base/error.hpp"
#include "engine/live/given_system.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::cli {

/// The tick of a recording that no run of nezumi can repeat [Hz].
inline constexpr double recorded_rate = 100;

class RecordedSystem {
public:
    /// A run of nezumi in simulation is repeated from its journal: all its components are there. Of other recordings,
    /// the topics are ports (`read_topics`). The system is not active yet. `file` is the name for errors; `names` are
    /// ports of topics; if there are some, a recording of nezumi is read from its topics too.
    static Expected<std::unique_ptr<RecordedSystem>> open(const std::filesystem::path& file,
                                                          const std::map<std::string, std::string>& names,
                                                          LiveOptions options);

    RunningSystem& live() { return *live_; }
    const RunningSystem& live() const { return *live_; }
    /// Gives the system away, to run it elsewhere. This object must outlive the system.
    std::unique_ptr<RunningSystem> take() { return std::move(live_); }
    /// Performs what happened before the next tick. Returns false at the end of the recording. An error if the repeated
    /// run differs from the recorded one.
    Expected<bool> before_tick(RunningSystem& live);
    /// The number of its ticks.
    std::int64_t ticks() const { return ticks_; }
    /// The replay, if it is one.
    const Replay* replay() const { return replay_.get(); }
    /// Lines for the user, about topics that are left out.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    std::unique_ptr<Replay> replay_;  // the system reads its files
    RecordedPorts ports_;
    std::unique_ptr<GivenSystem> given_;
    std::int64_t ticks_ = 0;
    std::vector<std::string> notes_;
    std::unique_ptr<RunningSystem> live_;
};

}  // namespace nezumi::cli
