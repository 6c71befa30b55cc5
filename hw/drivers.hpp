// The drivers of real robots and devices by name: the one door of this room.
#pragma once

#include "engine/system/build_system.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::hw {

/// Makers of real robots' bodies by the name of their driver, which is their backend.
ByBackend<BodyMaker> drivers(const DeviceRoots& roots);

/// Makers of components that are real devices, by type and by the name of their driver: the first of a type is its
/// usual one.
decltype(Makers::components) device_drivers(const DeviceRoots& roots);

}  // namespace nezumi::hw
