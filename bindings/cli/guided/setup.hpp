// From a file, or a model's name, to a robot that a sub-command drives.
#pragma once

#include <csignal>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/run/hardware.hpp"
#include "hw/calibrate/guided_robot.hpp"

namespace nezumi::cli {

/// Which robot is driven, and how it is reached.
struct GuidedSetup {
    std::string file;        ///< a system file
    std::string robot;       ///< its name there; "": the only one
    bool simulated = false;  ///< in the system's arena, as fast as can be
    Hardware hardware;       ///< of a real one; `robots` does not count
};

/// Which of these a person means: the only one, or the one that they want. An error says what there is in `file`; an
/// option `--KIND` says which one is wanted.
Expected<std::string> the_one(const std::vector<std::string_view>& names, const std::string& wanted,
                              std::string_view kind, const std::string& file);

/// The robot of a system file, as its calibration says where it has one. What it logs goes to standard error.
Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_file(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end);

/// The real robot of an installed model; it drives without the sensors that it needs otherwise.
Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_model(const std::string& model, const Hardware& hardware,
                                                           const volatile std::sig_atomic_t& end);

}  // namespace nezumi::cli
