// The parts of an examination; each appends its findings.
#pragma once

#include "hw/doctor/doctor.hpp"

namespace nezumi::hw {

/// The computer: its model, whether programs start on it, and its supply. Returns the computer's name from the
/// firmware, or "".
std::string examine_board(const MachineRoots& roots, Findings& findings);
void examine_mouse(const MachineRoots& roots, Findings& findings);
void examine_ev3(const MachineRoots& roots, Findings& findings);
/// The devices of a system, by their components' names.
void examine_devices(const std::vector<ComponentEntry>& devices, const MachineRoots& roots, Findings& findings);
/// Devices besides the robot: cameras and loudspeakers. A robot does not need them.
void examine_media(const MachineRoots& roots, Findings& findings);

}  // namespace nezumi::hw
