// Makes the behaviours of a system file, for `build_system`.
#pragma once

#include <memory>

#include "bindings/lua/script/script_component.hpp"
#include "engine/project/project.hpp"
#include "engine/system/build_system.hpp"

namespace nezumi {

/// Settings for all behaviours of a run.
struct BehaviorSettings {
    Project project;                                   ///< the project with their files and modules
    Budget budget = paced_budget;                      ///< `headless_budget` in runs that do not follow real time
    std::size_t memory_limit = std::size_t{64} << 20;  ///< [bytes] of each behaviour
    ChunkCache* chunks = nullptr;  ///< must outlive the behaviours; null: every behaviour compiles its own code
};

/// Returns a function that finds the modules of a project.
ModuleFinder modules_of(const Project& project);
/// Returns a function that finds the message types that files of a project define.
MessageFinder messages_of(const Project& project);

/// The initial parameter values of an entry: those of the parameter set in use override those of `config`.
ParameterValues values_at_start(const BehaviorEntry& entry);

/// Makes a behaviour; used for `Makers::behavior`.
Expected<std::unique_ptr<ScriptComponent>> make_behavior(const BehaviorEntry& entry, const MakerContext& context,
                                                         const BehaviorSettings& settings);

}  // namespace nezumi
