// The connections between ports of a system and other programs' RTCs: which are wanted. Who makes them is elsewhere.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/rtm_spec.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class System;

/// Whether OpenRTM-aist has a message type: all but what was added to its own.
bool is_rtm_type(std::string_view type);

/// Why a component's port can't be connected to `end`, a port of another program: the component is not exported.
std::string needs_export(std::string_view end, std::string_view component);

/// The two ends of a connection.
struct RtmEnds {
    std::string ours;  ///< "controller.in"
    RtmPath theirs;
};

/// Those of a connection between a port of a system and an RTC's. An error where not just one end is an RTC's, or the
/// other is no port, leads the wrong way, or carries a type that OpenRTM does not know.
Expected<RtmEnds> rtm_ends(const System& system, const ConnectionSpec& connection);

// What `connect` and `disconnect` do to a system that runs: `spec` is what it wants now.

/// An error also where our end's component is not exported, or there is this connection already.
Expected<void> connect_rtm(SystemSpec& spec, const System& system, const std::string& from, const std::string& to);
/// Takes one connection away, or with an empty `to` all of an end, of which either is ours. Returns how many.
std::size_t disconnect_rtm(SystemSpec& spec, std::string_view from, std::string_view to = "");
/// The other ends of "controller.in", or of "rtm:ConsoleOut0.out".
std::vector<std::string> rtm_peers(const SystemSpec& spec, std::string_view end);
/// A component of the system goes, and its connections with it.
void forget_rtm(SystemSpec& spec, std::string_view component);

}  // namespace nezumi
