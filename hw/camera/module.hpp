// What the program and its module for cameras know of each other: they are built together.
#pragma once

#include <string>

#include "hw/camera/capture.hpp"

namespace nezumi::hw {

inline constexpr const char* camera_module = "nezumi_camera.so";
inline constexpr const char* open_in_module = "nezumi_open_camera";

/// The module's one function: a new capture, or nullptr with the `problem`. It throws nothing.
using OpenInModule = Capture*(const std::string& node, const CaptureSettings& settings, std::string& problem);

}  // namespace nezumi::hw
