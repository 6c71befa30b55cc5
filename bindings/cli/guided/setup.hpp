// From a file, or a model's name, to a robot that a sub-command drives, or a camera that it looks through.
#pragma once

#include <csignal>
#include <memory>
#include <string>

#include "bindings/cli/run/hardware.hpp"
#include "hw/calibrate/guided_camera.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::cli {

/// Which robot or camera, and how it is reached.
struct GuidedSetup {
    std::string file;        ///< a system file
    std::string name;        ///< its name there; "": the only one
    bool simulated = false;  ///< as fast as can be: a robot in the system's arena, a camera over a chessboard
    Hardware hardware;       ///< of a real one; `robots` does not count
};

/// The robot of a system file, as its calibration says where it has one. What it logs goes to standard error.
Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_file(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end);

/// The camera of a system file, alone. Errors are those of the file, of the camera's parameters, or say which cameras
/// there are.
Expected<std::unique_ptr<hw::GuidedCamera>> guided_camera(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end);

/// The real robot of an installed model; it drives without the sensors that it needs otherwise.
Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_model(const std::string& model, const Hardware& hardware,
                                                           const volatile std::sig_atomic_t& end);

}  // namespace nezumi::cli
