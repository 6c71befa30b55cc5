// A world from above, drawn to a file: arena, robots, the paths they drove, the rays of their sensors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/draw/trajectories.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"
#include "engine/world/picture.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi::draw {

/// What a picture shows: taken from a system at one moment, drawn whenever.
struct PictureOf {
    struct Robot {
        std::string name;
        BodySpec body;
        DriveSpec drive;
        Pose2D pose;
        std::vector<Ray> rays;
        std::vector<Point2D> path;  ///< [m] oldest first
    };

    std::string title;
    double seconds = 0;  ///< simulated time
    std::optional<FloorSpec> floor;
    std::vector<LineSpec> lines{};
    std::vector<ThingPose> things;
    std::vector<Robot> robots;
};

/// Takes what there is to be seen now.
PictureOf look_at(const RunningSystem& live, const Trajectories& trajectories, std::string title);

/// Draws it to a file that ends in .png or .svg; what lies at no finite place is left out, and a floor's image that
/// `read` can't read. An error says why it can't be written; then there is no file.
Expected<void> draw_picture(PictureOf picture, const std::string& file, const PictureReader& read);

}  // namespace nezumi::draw
