// Prepares a robot that a sub-command drives, or a camera, from a system file or a model's name.
#pragma once

#include <csignal>
#include <memory>
#include <string>

#include "bindings/cli/run/hardware.hpp"
#include "hw/calibrate/guided_camera.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::cli {

/// Which robot or camera, and how to reach it.
struct GuidedSetup {
    std::string file;        ///< a system file
    std::string name;        ///< name of the robot or camera in the file; "": the only one
    bool simulated = false;  ///< as fast as possible: a robot in the system's arena, a camera over a chessboard
    Hardware hardware;       ///< for a real robot or camera; `robots` is not used
};

/// The robot of a system file, with its calibration if there is one. The robot's log goes to standard error.
Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_file(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end);

/// The camera of a system file, without the other components. Errors are those of the file or of the camera's
/// parameters; the error for a wrong or missing name lists the cameras.
Expected<std::unique_ptr<hw::GuidedCamera>> guided_camera(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end);

/// The real robot of an installed model. It drives even if sensors are missing that are normally required.
Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_model(const std::string& model, const Hardware& hardware,
                                                           const volatile std::sig_atomic_t& end);

}  // namespace nezumi::cli
