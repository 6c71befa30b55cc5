// Default answers of a world without markers and camera views.
#include "engine/world/world.hpp"

#include <fmt/format.h>

#include "engine/world/camera_source.hpp"

namespace nezumi {

Pose3D World::pose(RobotId robot) const {
    const Truth seen = truth(robot);
    return {.position = {seen.pose.position.x, seen.pose.position.y, seen.height},
            .orientation = {.y = seen.pose.heading}};
}

Expected<void> World::move_thing(std::string_view name, const Pose2D& /*pose*/) {
    return failure(fmt::format("there is no thing '{}' that can be moved in this world", shown(name)));
}

Expected<void> World::move_marker(std::string_view name, const Pose3D& /*pose*/) {
    return failure(fmt::format("there is no marker '{}' that can be moved in this world", shown(name)));
}

Expected<void> World::add_marker(const MarkerSpec& /*marker*/) {
    return failure("markers can't be added to this world");
}

Expected<void> World::remove_marker(std::string_view name) {
    return failure(fmt::format("there is no marker '{}' that can be removed from this world", shown(name)));
}

Expected<std::unique_ptr<CameraSource>> World::open_camera(const CameraMount& /*mount*/,
                                                           const CameraSettings& /*settings*/) {
    return failure("this world has no simulated cameras");
}

}  // namespace nezumi
