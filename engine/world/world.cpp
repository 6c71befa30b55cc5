// What a world answers that has neither markers nor a camera's view.
#include "engine/world/world.hpp"

#include <fmt/format.h>

#include "engine/world/camera_source.hpp"

namespace nezumi {

Expected<void> World::move_marker(std::string_view name, const Pose3D& /*pose*/) {
    return failure(fmt::format("there is no marker '{}' that could be moved here", shown(name)));
}

Expected<void> World::add_marker(const MarkerSpec& /*marker*/) { return failure("markers can't be hung up here"); }

Expected<void> World::remove_marker(std::string_view name) {
    return failure(fmt::format("there is no marker '{}' that could be removed here", shown(name)));
}

Expected<std::unique_ptr<CameraSource>> World::open_camera(const CameraMount& /*mount*/,
                                                           const CameraSettings& /*settings*/) {
    return failure("this world can't be looked at with a simulated camera");
}

}  // namespace nezumi
