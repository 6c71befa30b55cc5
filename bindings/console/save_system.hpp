// Writes the running system as a system file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/live/running_system.hpp"

namespace nezumi {

/// A copy of the data to save: made between two ticks, and written to the file by another thread.
struct PresentSystem {
    SystemSpec spec;
    Project project;
    std::vector<std::filesystem::path> installed;
    PeerWords peer_words;
};

/// The present connections and configuration as data: the entries of the file with the present parameter values,
/// without removed components, with the present connections. A value that was set by hand goes to the parameter set in
/// use if the set has it, otherwise to `config`; a value of a robot goes to its description. The error says that a
/// robot's changes could not be read again.
Expected<PresentSystem> present_system(const RunningSystem& live);

/// Writes the system as a system file and returns a sentence about it. The old file is kept as `FILE~`. Writes only
/// `.lua` files, and only within the project, or without a project within the folder of the system. If the result could
/// not be read again, it writes nothing and returns the reason.
Expected<std::string> save_system(PresentSystem present, const std::string& file);

}  // namespace nezumi
