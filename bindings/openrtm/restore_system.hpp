// Restores an RT system from a profile, as rtresurrect and rtstart do: its RTCs run already; they are connected,
// configured and activated.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/system_profile.hpp"

namespace nezumi::openrtm {

/// The name services that the paths of a profile begin with, as "HOST:PORT", without repetitions; an error names a path
/// that begins otherwise. "localhost:2809" for a profile without paths.
Expected<std::vector<std::string>> nameservers_of(const SystemProfile& profile);

/// The world of a restoration.
struct RestoreHost {
    /// Asks or changes RTCs; waits for the answer.
    std::function<PeerAnswer(const PeerQuestion&)> ask;
    /// Waits a moment for RTCs that are not running yet; false: long enough.
    std::function<bool()> wait;
    /// Reports a line; `is_problem`: something that could not be done.
    std::function<void(bool is_problem, const std::string& line)> say;
};

/// Restores it. If a component that the profile requires is not there, or has not the port of a connection, or is in
/// ERROR, nothing is changed. Each value, set, connection and activation that is refused is reported, and the others
/// are done; but a component with a refused connection or configuration is not activated. Returns whether all could be
/// done.
bool restore_system(const SystemProfile& profile, const RestoreHost& host);

}  // namespace nezumi::openrtm
