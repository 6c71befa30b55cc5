// The interface between the program and its camera module, which are always built together.
#pragma once

#include <string>

#include "hw/camera/capture.hpp"

namespace nezumi::hw {

inline constexpr const char* camera_module = "nezumi_camera.so";
inline constexpr const char* open_in_module = "nezumi_open_camera";

/// The only function that the module exports. Returns a new capture, or sets `problem` and returns nullptr. Never
/// throws.
using OpenInModule = Capture*(const std::string& node, const CaptureSettings& settings, std::string& problem);

}  // namespace nezumi::hw
