// The parts of an examination; each adds what it finds.
#pragma once

#include "hw/doctor/doctor.hpp"

namespace nezumi::hw {

/// The computer: which one it is, whether programs start on it, and its supply. Returns its name as its firmware tells
/// it, "" when it does not.
std::string examine_board(const MachineRoots& roots, Findings& findings);
void examine_mouse(const MachineRoots& roots, Findings& findings);
void examine_ev3(const MachineRoots& roots, Findings& findings);
/// What components beside the robot use: cameras and loudspeakers. A robot can do without.
void examine_media(const MachineRoots& roots, Findings& findings);

}  // namespace nezumi::hw
