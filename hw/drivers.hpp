// The drivers of real robots and devices by name: the public interface of this room.
#pragma once

#include "engine/system/build_system.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::hw {

/// Makers of real robots' bodies, by the driver's name (the backend).
ByBackend<BodyMaker> drivers(const DeviceRoots& roots);

/// Makers of real devices as components, by type and driver name. The first driver of a type is the default.
decltype(Makers::components) device_drivers(const DeviceRoots& roots);

/// Whether the real device of a component, of a type of `device_kinds()`, is there, may be used, and is used by no
/// other program. Sends nothing to it.
Expected<void> examine_device(const ComponentEntry& entry, const DeviceRoots& roots);

}  // namespace nezumi::hw
