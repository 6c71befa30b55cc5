// Makes the behaviours of a system file: what `build_system` asks the composition root for.
#pragma once

#include <memory>

#include "bindings/lua/script/script_component.hpp"
#include "engine/project/project.hpp"
#include "engine/system/build_system.hpp"

namespace nezumi {

/// What all behaviours of a run have in common.
struct BehaviorSettings {
    Project project;                                   ///< where their modules are found
    Budget budget = paced_budget;                      ///< `headless_budget` in runs without a clock
    std::size_t memory_limit = std::size_t{64} << 20;  ///< [bytes] of each
    ChunkCache* chunks = nullptr;  ///< must outlive the behaviours; null: every behaviour compiles its own
};

/// Finds the modules of a project.
ModuleFinder modules_of(const Project& project);

/// What an entry gives its parameters: those of the set in use before its `config`.
ParameterValues values_at_start(const BehaviorEntry& entry);

/// For `Makers::behavior`.
Expected<std::unique_ptr<ScriptComponent>> make_behavior(const BehaviorEntry& entry, const MakerContext& context,
                                                         const BehaviorSettings& settings);

}  // namespace nezumi
