// Performs the acts that change what a system is, together with the description that it was built from.
#pragma once

#include <string>
#include <vector>

#include "engine/system/act.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

// Each between two ticks: afterwards `spec` says what the system is now. On an error nothing has changed. A connection
// to an RTC is none between ports of the system: there it is `spec` alone that changes.
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const Connect& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const Disconnect& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const MoveMarker& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const MoveThing& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const AddMarker& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const RemoveMarker& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const Remove& act, const Actor& who);

/// "name.port" of what a port is connected to, and "rtm:NAME.port" of what it is to be connected to at RTCs.
std::vector<std::string> peers_of(const System& system, const SystemSpec& spec, const Component& component,
                                  const Port& port);

}  // namespace nezumi
