// The drivers of real robots by name: the one door of this room.
#pragma once

#include "engine/system/build_system.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::hw {

/// Makers of real robots' bodies by the name of their driver, which is their backend.
ByBackend<BodyMaker> drivers(const DeviceRoots& roots);

}  // namespace nezumi::hw
