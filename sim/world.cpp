// Checks an arena and makes its world.
#include "sim/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <system_error>

#include "engine/ports/payload.hpp"
#include "sim/markers.hpp"
#include "sim/ode_world.hpp"
#include "sim/paint_line.hpp"

namespace nezumi::sim {

Expected<std::unique_ptr<World>> make_world(const ArenaSpec& arena, const PhysicsSpec& physics,
                                            std::function<void(const std::string&)> warn) {
    if (!(physics.step > 0) || !std::isfinite(physics.step)) {
        return failure(fmt::format("the physics step must be a positive number of seconds, got {:g}", physics.step));
    }
    const auto positive = [](std::initializer_list<double> extents) {
        return std::all_of(extents.begin(), extents.end(), [](double e) { return e > 0 && std::isfinite(e); });
    };
    const auto finite = [](const Point3D& p) { return nezumi::is_finite(p); };
    for (const BoxSpec& box : arena.boxes) {
        if (!positive({box.size.x, box.size.y, box.size.z})) {
            return failure(fmt::format("a box needs a positive size, got {{ {:g}, {:g}, {:g} }}", box.size.x,
                                       box.size.y, box.size.z),
                           box.place);
        }
        if (!finite(box.at) || !std::isfinite(box.yaw) || !std::isfinite(box.pitch) || !std::isfinite(box.mass)) {
            return failure("a box needs finite numbers", box.place);
        }
    }
    for (const CylinderSpec& cylinder : arena.cylinders) {
        if (!positive({cylinder.radius, cylinder.height})) {
            return failure(fmt::format("a cylinder needs a positive radius and height, got {:g} and {:g}",
                                       cylinder.radius, cylinder.height),
                           cylinder.place);
        }
        if (!finite(cylinder.at) || !std::isfinite(cylinder.mass)) {
            return failure("a cylinder needs finite numbers", cylinder.place);
        }
    }
    if (arena.size && !positive({arena.size->x, arena.size->y})) {
        return failure(
            fmt::format("the arena needs a positive size, got {{ {:g}, {:g} }}", arena.size->x, arena.size->y));
    }
    for (const MarkerSpec& marker : arena.markers) {
        if (auto ok = check_marker(marker); !ok) return Unexpected(ok.error());
    }
    auto world = std::make_unique<OdeWorld>(arena, physics, std::move(warn));
    if (auto apart = world->check_things(); !apart) return Unexpected(apart.error());
    if (arena.floor) {
        auto picture = read_picture(arena.floor->image);
        if (!picture) return failure("floor: " + picture.error().message, arena.floor->place);
        for (const LineSpec& line : arena.lines) paint_line(*picture, arena.floor->size, line);
        world->take_floor(std::move(*picture), arena.floor->size);
    } else if (arena.size && !arena.lines.empty()) {
        Picture picture = plain_floor(*arena.size);
        for (const LineSpec& line : arena.lines) paint_line(picture, *arena.size, line);
        world->take_floor(std::move(picture), *arena.size);
    }
    return world;
}

WorldFactory make_worlds_with_sound(std::string folder) {
    return
        [folder = std::move(folder)](const ArenaSpec& arena, const PhysicsSpec& physics,
                                     std::function<void(const std::string&)> warn) -> Expected<std::unique_ptr<World>> {
            std::error_code problem;
            std::filesystem::create_directories(folder, problem);
            if (problem || !std::filesystem::is_directory(folder, problem)) {
                return failure(fmt::format("'{}' can't be made a folder for sounds{}", folder,
                                           problem ? ": " + problem.message() : ""));
            }
            auto world = make_world(arena, physics, std::move(warn));
            if (world) static_cast<OdeWorld&>(**world).keep_sounds(folder);
            return world;
        };
}

}  // namespace nezumi::sim
