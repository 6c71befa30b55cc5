// What keeps this machine from driving its robot: driver, nodes, permissions, board, supply, camera and sound.
#pragma once

#include <functional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hw/camera/capture.hpp"
#include "hw/device/roots.hpp"
#include "hw/doctor/finding.hpp"

namespace nezumi::hw {

/// Where a machine, and the program that looks at it, tell of themselves.
struct MachineRoots {
    DeviceRoots devices;
    std::string proc = "/proc";
    std::vector<std::string> udev{"/etc/udev", "/lib/udev"};  ///< each has a folder `rules.d`
    std::string rules;  ///< the file of rules that comes with nezumi, for who has to install it
    /// Whether this program can use cameras; only asked where there is one.
    std::function<tl::expected<void, std::string>()> load_cameras = load_opencv;
};

struct Examination {
    std::string driver;  ///< of the robot that this machine belongs to: "raspimouse", "ev3"; "": it is none
    Findings findings;
};

/// Looks at all of it, and writes nothing. A device that hangs costs a second.
Examination examine(const MachineRoots& roots);

}  // namespace nezumi::hw
