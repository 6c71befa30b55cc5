// Computes a past moment of a running system again, beside it and in pieces.
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
    /// From 0 to 1.
    double progress() const;

    const Seek& where() const { return where_; }
    std::size_t branch() const { return branch_; }
    /// `RunningSystem::generation` of the system whose past this is.
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
          memory_(live.trace().memory()) {}
    bool is_there() const { return !is_earlier(system_->when(), to_); }
    void remember_when_near();

    RecordedFiles files_;
    std::size_t branch_;
    Seek where_;
    ActTime to_;
    int generation_;
    std::optional<Trace::Memory> memory_;  // none after it began to remember
    std::unique_ptr<RunningSystem> system_;
};

}  // namespace nezumi
