// Computes a past moment of a running system again, in small pieces while it runs.
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

    /// Loads the system of `live` as at its first start, to compute `where`: a moment of this branch, at this time.
    static Expected<std::unique_ptr<PastRun>> begin(RunningSystem& live, std::size_t branch, const Seek& where,
                                                    const ActTime& to);

    /// Computes until this time. Returns whether the moment is reached. The error has the time at which the system
    /// differed from the original run.
    Expected<bool> go_on(Clock::time_point until);
    /// The same beside a system that moves, whose next tick is due at this time: begins no tick that would probably end
    /// later. Where there is never enough time for one, it takes 1 ms of each 100.
    Expected<bool> go_on_beside(Clock::time_point until);
    /// Remembers these values from this tick of the last start on, instead of what the present remembers before the
    /// moment. Call it before `go_on`.
    void remember(Trace::Memory memory, std::int64_t from);
    /// Goes on to a later tick of the same start, up to which everything was known at the beginning.
    void extend(std::int64_t tick) { to_.tick = tick; }
    /// From 0 to 1.
    double progress() const;

    const Seek& where() const { return where_; }
    std::size_t branch() const { return branch_; }
    /// `RunningSystem::generation` of the system that this past belongs to.
    int generation() const { return generation_; }
    /// The system that computes it.
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
    std::int64_t memory_from_;                    // the tick
    std::optional<std::uint64_t> memory_layout_;  // of the system when it was told to remember
    std::int64_t ticks_ = 0;                      // that were computed
    Clock::duration tick_time_{};                 // of one, about
    Clock::time_point worked_{};                  // beside a system that moves
    std::unique_ptr<RunningSystem> system_;
};

}  // namespace nezumi
