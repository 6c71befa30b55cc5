// What acts read and load before they are performed: copies of all that this takes, to be called in any thread.
#pragma once

#include <functional>
#include <memory>

#include "engine/live/prepared_act.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// Completes a prepared act from the files of `project`, which are a snapshot; may print into it.
using PreparingWork = std::function<void(PreparedAct& prepared, const Project& project)>;

PreparingWork work_of(const Reload& act, const RunningSystem& live, const Reloads& reloads);
PreparingWork work_of(const Add& act, const RunningSystem& live);
PreparingWork work_of(const Restart& act, const RunningSystem& live);

/// The script of a component, or why it has none.
Expected<const ScriptFile*> script_of(const System& system, const std::string& name);

/// The system of a file, as these options change it.
Expected<SystemSpec> read_spec(const std::filesystem::path& file, const Project& project, const LiveOptions& options);
/// Reads and loads what a system is built from beside its description.
std::unique_ptr<Behaviors> load_behaviors(const SystemSpec& spec, const MakerContext& context, const Project& project,
                                          const LiveOptions& options);

}  // namespace nezumi
