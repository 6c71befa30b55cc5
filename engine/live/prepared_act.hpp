// An act with all that it takes of files and scripts, to be performed between two ticks.
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

/// Whether an act reads files or loads scripts: it is prepared before it is performed.
inline bool takes_files(const Act& act) {
    return std::holds_alternative<Reload>(act) || std::holds_alternative<Add>(act) ||
           std::holds_alternative<Restart>(act);
}

/// What `RunningSystem::prepare` has made ready for `RunningSystem::commit`.
struct PreparedAct {
    Act act;                       ///< as it is performed: a `Reload` of whatever has changed names the files
    int start = 0;                 ///< of the system that it was prepared for
    FilesSeen files{};             ///< what it has found of files
    std::optional<Error> error{};  ///< why it can't be performed

    std::unique_ptr<PreparedReload> reload{};
    std::unique_ptr<Behaviors> behaviors{};  ///< that `Add` or `Restart` has loaded
    SystemSpec
        spec{};  ///< what `Restart` builds; of `Add` the entry, its calibration in use, with its models and files
    std::vector<std::string> printed{};  ///< lines that the system file has printed
    std::vector<std::string> lost{};     ///< components and markers of acts that `Restart` would lose
};

/// Reads, loads and may wait: to be called once, in any thread, without the system, which it may outlive.
using Preparation = std::function<PreparedAct()>;

}  // namespace nezumi
