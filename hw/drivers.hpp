// The public interface of hw/: the drivers of real robots and devices, by name.
#pragma once

#include "engine/system/build_system.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::hw {

/// Functions that make the bodies of real robots, by the driver's name (the backend).
ByBackend<BodyMaker> drivers(const DeviceRoots& roots);

/// Functions that make components for real devices, by type and driver name. The first driver of a type is the default.
decltype(Makers::components) device_drivers(const DeviceRoots& roots);

/// Checks that the real device of a component exists, that this user may use it, and that no other program uses it. The
/// component's type must be one of `device_kinds()`. Sends nothing to the device.
Expected<void> examine_device(const ComponentEntry& entry, const DeviceRoots& roots);

}  // namespace nezumi::hw
