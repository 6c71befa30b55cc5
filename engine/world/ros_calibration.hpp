// Calibrations of cameras as ROS's camera_calibration writes them: ost.yaml.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {

/// Reads the YAML file: the size of the pictures, the camera's matrix, and the lens as plumb_bob or
/// rational_polynomial. `file` is named in errors, which say the line.
Expected<CameraIntrinsics> read_ros_calibration(std::string_view text, const std::string& file);

}  // namespace nezumi
