// From a system as data to a system that runs, or the one message that says why not.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "engine/base/error.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// What the makers of components may know about the system they are for.
struct MakerContext {
    std::uint64_t seed = 0;  ///< of the run
    double tick_rate = 100;  ///< [Hz]
};

/// How components come into being: given by the composition root, so that the engine knows neither Lua nor ODE.
struct Makers {
    /// May be empty: a system without robots needs no world.
    WorldFactory world;
    std::function<Expected<std::unique_ptr<Component>>(const BehaviorEntry& entry, const MakerContext& context)>
        behavior;
    /// Native components by type.
    std::map<std::string,
             std::function<Expected<std::unique_ptr<Component>>(const ComponentEntry& entry, System& system)>,
             std::less<>>
        components;
};

struct BuildOptions {
    std::uint64_t seed = 0;  ///< used when the system file gives none
    bool seed_wins = false;  ///< the seed counts even when the file gives one
    int threads = 1;
    bool out_of_time_is_fatal = false;
    LogSink log;
};

/// Builds the world, every entry in order and the connections, and gives parameters their values. Nothing is activated.
/// `spec` must outlive the system. Errors carry the place of the line that is wrong.
Expected<std::unique_ptr<System>> build_system(const SystemSpec& spec, const Makers& makers,
                                               const BuildOptions& options);

/// Adds one entry to a system that exists, without activating it (scenarios add while they run).
Expected<Component*> add_entry(System& system, const Entry& entry, const SystemSpec& spec, const Makers& makers);

/// Activates every component that the file does not keep inactive, in order. A component that can't be activated is in
/// ERROR; the others go on.
void activate_all(System& system, const SystemSpec& spec);

}  // namespace nezumi
