// The parts of a running system that a restart or a seek replaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "engine/live/live_reload.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// Members are destroyed in the reverse order of declaration.
struct RunningSystem::Running {
    LogSink log;    // empty while the past is computed: nothing is logged
    int start = 0;  // number of the start, for log lines
    SystemSpec spec;
    std::unique_ptr<Behaviors> behaviors;
    Makers makers;
    std::unique_ptr<System> system;
    TraceHash hash;
    std::unique_ptr<Reloads> reloads;
    std::optional<LiveReload> live_reload;
};

/// The present of a system with peers, kept while the system is in its past.
struct RunningSystem::Away {
    Trace trace;  // declared before the system that it observes
    std::unique_ptr<Running> running;
    std::size_t branch = 0;
    ActTime when{};
    int starts = 0;
    std::optional<std::uint64_t> hash_before;
};

}  // namespace nezumi
