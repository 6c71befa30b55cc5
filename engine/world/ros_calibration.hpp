// Reads calibrations of cameras from ROS's camera_calibration: ost.yaml.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {

/// Reads the YAML file: size of pictures, camera matrix, and distortion as plumb_bob or rational_polynomial. Errors
/// have `file` and the line.
Expected<CameraIntrinsics> read_ros_calibration(std::string_view text, const std::string& file);

}  // namespace nezumi
