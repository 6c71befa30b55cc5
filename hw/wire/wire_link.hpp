// A real device on a wire: one thread reads it, and a separate process writes to it.
#pragma once

#include <memory>

#include "engine/devices/wired_device.hpp"
#include "hw/device/roots.hpp"
#include "hw/wire/wire_driver.hpp"

namespace nezumi::hw {

/// Opens a device with the driver of its kind. Fails if the device is of another kind, if another program writes to it,
/// or if a device with safe bytes is missing. A device without safe bytes may be plugged in later. After a device was
/// unplugged, it is searched for every half second.
Expected<std::unique_ptr<DeviceLink>> open_wire(MakeWireDriver make, const Parameters& parameters,
                                                const DeviceRoots& roots);

}  // namespace nezumi::hw
