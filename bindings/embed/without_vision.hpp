// Systems of a program without cameras and vision.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/live/running_system.hpp"

namespace nezumi {

/// As `simulated_systems`, but without a world, and with an error for components that need a camera: "this build of
/// nezumi has no cameras and no vision, so the type Camera is missing". `program`: "this build of nezumi".
LiveOptions systems_without_vision(std::vector<std::filesystem::path> installed, const std::string& program);

}  // namespace nezumi
