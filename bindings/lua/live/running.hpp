// What a live system holds from one start to the next.
#pragma once

#include <memory>
#include <optional>

#include "bindings/lua/live/live_system.hpp"

namespace nezumi {

/// All that a restart replaces. Declaration order is destruction order reversed.
struct LiveSystem::Running {
    SystemSpec spec;
    ChunkCache chunks;
    std::unique_ptr<Component> prepared;  // what the maker of behaviours gives next, instead of making it
    Makers makers;
    std::unique_ptr<System> system;
    TraceHash hash;
    std::optional<Reloader> reloader;
    std::optional<LiveReload> live_reload;
};

}  // namespace nezumi
