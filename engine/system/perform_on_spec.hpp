// Performs acts that change a system together with its description.
#pragma once

#include "engine/system/act.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

// Call these between two ticks. Afterwards `spec` describes the changed system. After an error nothing has changed.
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const MoveMarker& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const MoveThing& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const AddMarker& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const RemoveMarker& act, const Actor& who);
Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const Remove& act, const Actor& who);

}  // namespace nezumi
