// The system that runs, as a system file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/live/running_system.hpp"

namespace nezumi {

/// A copy of what there is to save: looked up between two ticks, written beside them.
struct PresentSystem {
    SystemSpec spec;
    Project project;
    std::vector<std::filesystem::path> installed;
};

/// The present wiring and configuration as data: entries as the file gave them with the parameters' values of now,
/// components that are gone left out, connections as they are. A value that was set by hand is in the set in use if
/// that names it, else in `config`, a robot's in its description. An error when what a system file says of a robot
/// can't be read any more.
Expected<PresentSystem> present_system(const RunningSystem& live);

/// Writes it as a system file and says in a sentence what was done. What was there is kept beside it, as `FILE~`. Only
/// `.lua` files are written, and only within the project, or where there is none, in and below the system's folder.
/// Nothing is written when the file could not be read back: the error says why.
Expected<std::string> save_system(PresentSystem present, const std::string& file);

}  // namespace nezumi
