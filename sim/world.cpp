// Checks an arena and makes its world.
#include "sim/world.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "engine/world/arena_fields.hpp"
#include "sim/markers.hpp"
#include "sim/ode_world.hpp"
#include "sim/paint_line.hpp"

namespace nezumi::sim {

Expected<std::unique_ptr<World>> make_world(const ArenaSpec& arena, const PhysicsSpec& physics,
                                            std::function<void(const std::string&)> warn) {
    if (const std::string problem = check_number(physics.step, {.range = NumberRange::positive}, "s"); !problem.empty())
        return failure("physics: the step: " + problem);
    if (auto ok = check_arena(arena); !ok) return Unexpected(ok.error());
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
                return failure(fmt::format("'{}' can't be made as a folder for sounds{}", folder,
                                           problem ? ": " + problem.message() : ""));
            }
            auto world = make_world(arena, physics, std::move(warn));
            if (world) static_cast<OdeWorld&>(**world).keep_sounds(folder);
            return world;
        };
}

}  // namespace nezumi::sim
