// Robots whose drivers are behaviours: the entries of a driver, and its connections.
#pragma once

#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class System;

/// Adds, after each robot whose model has `hardware.script`, its driver (behaviour NAME_driver), and each device
/// (component NAME_DEVICE). For a simulated robot only if the model has a `device_model`, which becomes the behaviour
/// NAME_model. An error if such a name is taken.
Expected<void> add_script_drivers(SystemSpec& spec);

/// Removes what `add_script_drivers` has added, with its connections.
void leave_out_script_drivers(SystemSpec& spec);

/// Connects each driver, and each device model, with its robot and its devices, by the names of the ports. An error
/// names a port that is neither the robot's nor a device's.
Expected<void> connect_script_drivers(System& system, const SystemSpec& spec);

}  // namespace nezumi
