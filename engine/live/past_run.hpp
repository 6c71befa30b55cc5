// Computes a past moment of a running system again, in small pieces while the system runs.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>

#include "engine/live/running_system.hpp"
#include "engine/time/recorded_files.hpp"

namespace nezumi {

class PastRun {
public:
    using Clock = std::chrono::steady_clock;

    /// Loads the system of `live` as at its first start, to compute the moment `where` of this branch, at the time
    /// `to`.
    static Expected<std::unique_ptr<PastRun>> begin(RunningSystem& live, std::size_t branch, const Seek& where,
                                                    const ActTime& to);

    /// Computes until this time. Returns whether the moment is reached. The error has the time at which the system
    /// differed from the original run.
    Expected<bool> go_on(Clock::time_point until);
    /// Like `go_on`, while the original system runs and its next tick is due at `until`: begins no tick that would
    /// probably end later. If there is never enough time for a tick, uses 1 ms of every 100 ms.
    Expected<bool> go_on_beside(Clock::time_point until);
    /// Remembers the values of `memory` from tick `from` of the last start on, instead of those that the present
    /// remembers. Call this before `go_on`.
    void remember(Trace::Memory memory, std::int64_t from);
    /// Extends the computation to a later tick of the same start. All events up to this tick must have been known at
    /// `begin`.
    void extend(std::int64_t tick) { to_.tick = tick; }
    /// The progress, from 0 to 1.
    double progress() const;

    const Seek& where() const { return where_; }
    std::size_t branch() const { return branch_; }
    /// `RunningSystem::generation` of the system that this past belongs to.
    int generation() const { return generation_; }
    /// The system that computes the moment.
    RunningSystem& system() { return *system_; }

private:
    PastRun(RunningSystem& live, std::size_t branch, Seek where, const ActTime& to)
        : files_(live.project().files().working_folder()),
          branch_(branch),
          where_(std::move(where)),
          to_(to),
          generation_(live.generation()),
          memory_(live.trace().memory()),
          memory_from_(to.tick - static_cast<std::int64_t>(memory_.most_samples)) {}
    bool is_there() const { return !is_earlier(system_->when(), to_); }
    void remember_when_near();

    RecordedFiles files_;
    std::size_t branch_;
    Seek where_;
    ActTime to_;
    int generation_;
    Trace::Memory memory_;
    std::int64_t memory_from_;                    // the first remembered tick
    std::optional<std::uint64_t> memory_layout_;  // layout of the system when remembering began
    std::int64_t ticks_ = 0;                      // number of computed ticks
    Clock::duration tick_time_{};                 // estimated duration of a tick
    Clock::time_point worked_{};                  // end of the last work of `go_on_beside`
    std::unique_ptr<RunningSystem> system_;
};

}  // namespace nezumi
