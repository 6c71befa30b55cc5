// Pictures of a simulated camera and what is found in them, for the tests of vision/.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <vector>

#include "engine/devices/camera.hpp"
#include "engine/vision/tag_finder.hpp"
#include "engine/world/camera_source.hpp"
#include "sim/world.hpp"

namespace nezumi {

inline constexpr double field_of_view = 1.0472;

inline std::unique_ptr<World> world_with(const ArenaSpec& arena) {
    auto world = sim::make_world(arena, {.step = 0.005, .seed = 1}, {});
    INFO((world ? "" : world.error().message));
    REQUIRE(world);
    return std::move(*world);
}

inline ArenaSpec one_marker(Point3D at = {1, 0, 0.1}, double facing = M_PI, double size = 0.1) {
    ArenaSpec arena;
    arena.markers.push_back({.name = "target", .id = 7, .size = size, .at = at, .facing = facing});
    return arena;
}

/// What a camera at the height of 0.1 m over the origin sees, looking along x.
inline CameraImage picture_of(World& world, CameraSettings settings = {.field_of_view = field_of_view},
                              CameraMount mount = {.at = {0, 0, 0.1}}) {
    auto camera = world.open_camera(mount, settings);
    REQUIRE(camera);
    CameraImage image;
    (*camera)->expose({});
    (*camera)->develop(image);
    return image;
}

inline std::vector<FoundTag> tags_in(const CameraImage& image, double size = 0.1) {
    auto gray = to_gray(image);
    REQUIRE(gray);
    return TagFinder("36h11").find(*gray, pinhole(image.width, image.height, field_of_view), size);
}

inline FoundTag only_tag(World& world, double size = 0.1) {
    const auto tags = tags_in(picture_of(world), size);
    REQUIRE(tags.size() == 1);
    return tags.front();
}

}  // namespace nezumi
