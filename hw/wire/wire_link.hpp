// A real device on a wire: one thread reads it, a process of its own writes to it.
#pragma once

#include <memory>

#include "engine/devices/wired_device.hpp"
#include "hw/device/roots.hpp"
#include "hw/wire/wire_driver.hpp"

namespace nezumi::hw {

/// Opens a device with the driver of its kind. Fails if the device is of another kind, if another program
/// writes to it, or if it has safe bytes and is missing. A device that only measures may come later. A device that was
/// unplugged is looked for every half second.
Expected<std::unique_ptr<DeviceLink>> open_wire(MakeWireDriver make, const Parameters& parameters,
                                                const DeviceRoots& roots);

}  // namespace nezumi::hw
