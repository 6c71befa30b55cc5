// Examines the machine according to its kind of robot.
#include "hw/doctor/doctor.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "hw/doctor/examine.hpp"
#include "hw/doctor/machine_queries.hpp"

namespace nezumi::hw {
namespace {

bool is_there(const std::string& path) {
    std::error_code none;
    return std::filesystem::exists(path, none);
}

bool is_mouse(const MachineRoots& roots) {
    const auto names = names_in(roots.devices.dev);
    return is_there(roots.devices.sys + "/module/rtmouse") ||
           std::any_of(names.begin(), names.end(), [](const std::string& name) {
               return name.starts_with("rtmotor") || name.starts_with("rtlightsensor");
           });
}

}  // namespace

Examination examine(const MachineRoots& roots, const std::vector<ComponentEntry>& devices) {
    Examination examination;
    Findings& findings = examination.findings;
    const std::string board = examine_board(roots, findings);
    if (is_mouse(roots) || board.starts_with("Raspberry Pi")) {
        examination.driver = "raspimouse";
        examine_mouse(roots, findings);
    } else if (is_there(roots.devices.sys + "/class/tacho-motor") || board.find("EV3") != board.npos) {
        examination.driver = "ev3";
        examine_ev3(roots, findings);
    } else if (devices.empty()) {
        findings.push_back({"robot", Finding::State::wrong, "this machine is neither a Raspberry Pi Mouse nor an EV3",
                            "run nezumi doctor on the robot; here systems are simulated, so nothing more is needed"});
    }
    examine_devices(devices, roots, findings);
    examine_media(roots, findings);
    return examination;
}

}  // namespace nezumi::hw
