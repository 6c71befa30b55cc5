// The parts of a running system that a restart replaces.
#pragma once

#include <memory>
#include <optional>

#include "engine/live/live_reload.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// Members are destroyed in the reverse order of declaration.
struct RunningSystem::Running {
    LogSink log;    // empty: while the past is computed, nothing is logged
    int start = 0;  // number of the start, for log lines
    SystemSpec spec;
    std::unique_ptr<Behaviors> behaviors;
    Makers makers;
    std::unique_ptr<System> system;
    TraceHash hash;
    std::unique_ptr<Reloads> reloads;
    std::optional<LiveReload> live_reload;
};

}  // namespace nezumi
