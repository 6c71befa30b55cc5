// Restores an RT system from a profile, as rtresurrect and rtstart do: connects, configures and activates RTCs, which
// must be running already.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/system_profile.hpp"

namespace nezumi::openrtm {

/// The name services of a profile's components, "HOST:PORT", each once: the first parts of the components' paths. An
/// error names a path whose first part is no name service. "localhost:2809" for a profile without paths.
Expected<std::vector<std::string>> nameservers_of(const SystemProfile& profile);

/// The functions that a restoration uses.
struct RestoreHost {
    /// Asks or changes RTCs; waits for the answer.
    std::function<PeerAnswer(const PeerQuestion&)> ask;
    /// Waits a moment for RTCs that are not running yet. Returns false if the waiting is over.
    std::function<bool()> wait;
    /// Reports a line; `is_problem`: something that could not be done.
    std::function<void(bool is_problem, const std::string& line)> say;
};

/// Restores the system. Nothing is changed if a required component is missing, is in ERROR, or lacks the port of a
/// connection. Each refused value, set, connection and activation is reported, and the others are done. A component
/// with a refused connection or configuration is not activated. Returns true if everything was done.
bool restore_system(const SystemProfile& profile, const RestoreHost& host);

}  // namespace nezumi::openrtm
