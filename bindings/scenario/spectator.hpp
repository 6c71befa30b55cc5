// An observer of a running scenario.
#pragma once

#include "bindings/scenario/run_result.hpp"
#include "engine/base/log.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

class Spectator {
public:
    virtual ~Spectator() = default;
    /// Lets the first world of the run make exactly one tick. It may wait before the tick.
    virtual void tick(RunningSystem& live) = 0;
    /// A line of any world's log.
    virtual void log(const LogLine& line) = 0;
    /// The run has ended with this result. Its worlds exist until this function returns.
    virtual void ended(const RunResult& result) = 0;
};

}  // namespace nezumi
