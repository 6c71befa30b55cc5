// What a live system holds from one start to the next.
#pragma once

#include <memory>
#include <optional>

#include "engine/live/live_reload.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// All that a restart replaces. Declaration order is destruction order reversed.
struct RunningSystem::Running {
    SystemSpec spec;
    std::unique_ptr<Behaviors> behaviors;
    Makers makers;
    std::unique_ptr<System> system;
    TraceHash hash;
    std::unique_ptr<Reloads> reloads;
    std::optional<LiveReload> live_reload;
};

}  // namespace nezumi
