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

/// [Hz] The tick rate for a recording that can't be repeated as a run of nezumi.
inline constexpr double recorded_rate = 100;

class RecordedSystem {
public:
    /// Opens a journal or a recording. A simulated run of nezumi is repeated from its journal, with all its components.
    /// In other recordings each topic becomes a port (`read_topics`); `names` gives ports to topics. If `names` is not
    /// empty, a recording of nezumi is also opened from its topics. The system is not active yet.
    static Expected<std::unique_ptr<RecordedSystem>> open(const std::filesystem::path& file,
                                                          const std::map<std::string, std::string>& names,
                                                          LiveOptions options);

    RunningSystem& live() { return *live_; }
    const RunningSystem& live() const { return *live_; }
    /// Gives the system away, to run it elsewhere. This object must outlive the system.
    std::unique_ptr<RunningSystem> take() { return std::move(live_); }
    /// Performs the acts that were recorded before the next tick, if it is a replay. Returns false at the end of the
    /// recording. An error if the repeated run differs from the recorded one.
    Expected<bool> before_tick(RunningSystem& live);
    /// The number of ticks of the recording.
    std::int64_t ticks() const { return ticks_; }
    /// The replay; nullptr if the messages are taken from topics.
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
