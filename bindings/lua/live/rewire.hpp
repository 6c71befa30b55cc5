// Connects and disconnects ports of a system that runs, with each other and with RTCs of other programs.
#pragma once

#include "engine/system/act.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

// Connections to RTCs are none between ports of the system: what `spec` wants of them is changed.
Expected<ActResult> rewire(System& system, SystemSpec& spec, const Connect& act, const Actor& who);
Expected<ActResult> rewire(System& system, SystemSpec& spec, const Disconnect& act, const Actor& who);

}  // namespace nezumi
