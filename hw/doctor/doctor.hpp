// What keeps this machine from driving its robot: driver, nodes, permissions, board, supply, camera and sound.
#pragma once

#include <string>
#include <vector>

#include "hw/device/roots.hpp"
#include "hw/doctor/finding.hpp"

namespace nezumi::hw {

/// Where a machine tells of itself.
struct MachineRoots {
    DeviceRoots devices;
    std::string proc = "/proc";
    std::vector<std::string> udev{"/etc/udev", "/lib/udev"};  ///< each has a folder `rules.d`
    std::string rules;  ///< the file of rules that comes with nezumi, for who has to install it
};

struct Examination {
    std::string driver;  ///< of the robot that this machine belongs to: "raspimouse", "ev3"; "": it is none
    Findings findings;
};

/// Looks at all of it, and writes nothing. A device that hangs costs a second.
Examination examine(const MachineRoots& roots);

}  // namespace nezumi::hw
