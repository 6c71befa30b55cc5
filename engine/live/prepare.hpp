// Prepares acts: reads and loads what they need. The functions own copies of their data, and can be called in any
// thread.
#pragma once

#include <functional>
#include <memory>

#include "engine/live/prepared_act.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// Completes a prepared act with files of `project`, which is a snapshot; may print into the act.
using PreparingWork = std::function<void(PreparedAct& prepared, const Project& project)>;

PreparingWork work_of(const Reload& act, const RunningSystem& live, const Reloads& reloads);
PreparingWork work_of(const Add& act, const RunningSystem& live);
PreparingWork work_of(const Restart& act, const RunningSystem& live);

/// The script of a component; an error if it has none.
Expected<const ScriptFile*> script_of(const System& system, const std::string& name);

/// Reads the system of a file and applies these options.
Expected<SystemSpec> read_spec(const std::filesystem::path& file, const Project& project, const LiveOptions& options);
/// Loads the behaviours of a system.
std::unique_ptr<Behaviors> load_behaviors(const SystemSpec& spec, const MakerContext& context, const Project& project,
                                          const LiveOptions& options);

}  // namespace nezumi
