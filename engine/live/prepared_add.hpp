// What an `Add` reads and runs before the system changes: beside the ticks where a console asks for it.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/live/script_host.hpp"
#include "engine/system/act.hpp"

namespace nezumi {

/// An entry with all that it needs of files.
struct PreparedAdd {
    Entry given;  ///< as it was asked for
    Entry entry;  ///< the same with its calibration in use
    int start = 0;
    std::map<std::string, RobotSpec> models{};   ///< of a robot
    std::vector<std::string> files{};            ///< that a robot was read from, as `SystemSpec::files`
    std::unique_ptr<LoadedBehavior> behavior{};  ///< null: it is none, or is loaded when it is added
    FilesSeen seen{};                            ///< in another thread
};

/// Prepares additions to a system: a copy of what that takes.
struct AddPreparer {
    const ScriptHost* scripts;
    Project project;
    BehaviorLoader load;
    MakerContext context;
    int start = 0;

    /// In a thread that may wait: what was read is noted in `files`, through which `part` was read, and is handed
    /// along. `part` is the system with the entry, as the words of a system file give it.
    Expected<PreparedAdd> beside(const Entry& entry, SystemSpec part, NotedFiles& files) const;
    /// Between two ticks.
    Expected<PreparedAdd> here(const Entry& entry, SystemSpec part) const { return read(entry, part, project); }

private:
    Expected<PreparedAdd> read(const Entry& entry, SystemSpec& part, const Project& project) const;
};

}  // namespace nezumi
