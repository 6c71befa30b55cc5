// An act with the files and scripts that it needs, ready to be performed between two ticks.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/live/script_host.hpp"
#include "engine/project/project_files.hpp"
#include "engine/system/act.hpp"

namespace nezumi {

/// Whether an act reads files or loads scripts, so that it must be prepared.
inline bool takes_files(const Act& act) {
    return std::holds_alternative<Reload>(act) || std::holds_alternative<Add>(act) ||
           std::holds_alternative<Restart>(act);
}

/// The result of `RunningSystem::prepare` for `RunningSystem::commit`.
struct PreparedAct {
    Act act;                       ///< the act to perform: a `Reload` of all changed files has their names
    int generation = 0;            ///< of the system that the act was prepared for
    FilesSeen files{};             ///< the files that were read
    std::optional<Error> error{};  ///< why the act can't be performed

    std::unique_ptr<PreparedReload> reload{};
    std::unique_ptr<Behaviors> behaviors{};  ///< behaviours that `Add` or `Restart` has loaded
    SystemSpec spec{};  ///< the system for `Restart`; for `Add`, the entry with its calibration, models and files
    std::vector<std::string> printed{};  ///< lines that the system file has printed
    std::vector<std::string> lost{};     ///< components and markers of acts that `Restart` would lose
};

/// A function that prepares an act: reads and loads, and may wait. Call it once, in any thread. It does not use the
/// system, and may outlive the system.
using Preparation = std::function<PreparedAct()>;

}  // namespace nezumi
