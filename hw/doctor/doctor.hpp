// Finds what prevents this machine from driving its robot: driver, device nodes, permissions, board, supply, camera and
// sound.
#pragma once

#include <functional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "engine/system/system_spec.hpp"
#include "hw/camera/capture.hpp"
#include "hw/device/roots.hpp"
#include "hw/doctor/finding.hpp"

namespace nezumi::hw {

/// The folders with information about the machine and the program.
struct MachineRoots {
    DeviceRoots devices;
    std::string proc = "/proc";
    std::vector<std::string> udev{"/etc/udev", "/lib/udev"};  ///< each has a folder `rules.d`
    std::string rules;  ///< path of the udev rules that come with nezumi, for the advice to install them
    /// Tests whether this program can use cameras. Called only if there is a camera.
    std::function<tl::expected<void, std::string>()> load_cameras = load_opencv;
};

struct Examination {
    std::string driver;  ///< the machine's robot: "raspimouse", "ev3", or "" for none
    Findings findings;
};

/// Examines everything without writing, also these devices (`device_kinds()`). A device that does not answer takes one
/// second.
Examination examine(const MachineRoots& roots, const std::vector<ComponentEntry>& devices = {});

}  // namespace nezumi::hw
