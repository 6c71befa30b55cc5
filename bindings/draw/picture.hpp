// A drawing of the world from above: arena, robots with their paths and sensor rays.
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

/// The contents of a picture: copied from a system at one moment, so it may be drawn later.
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

/// Copies the present state of a system.
PictureOf look_at(const RunningSystem& live, const Trajectories& trajectories, std::string title);

/// Draws the picture to a file that ends in .png or .svg. Positions that are not finite, and a floor's image that
/// `read` can't read, are left out. The error says why the file can't be written; then there is no file.
Expected<void> draw_picture(PictureOf picture, const std::string& file, const PictureReader& read);

}  // namespace nezumi::draw
