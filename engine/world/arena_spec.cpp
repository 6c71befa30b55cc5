// Boxes and cylinders have no names in a system file, so they are numbered.
#include "engine/world/arena_spec.hpp"

#include <fmt/format.h>

namespace nezumi {

std::string thing_name(std::string_view shape, std::size_t index) { return fmt::format("{} {}", shape, index + 1); }

void move_thing(ArenaSpec& arena, std::string_view name, const Pose2D& pose) {
    for (std::size_t i = 0; i < arena.boxes.size(); ++i) {
        if (thing_name("box", i) != name) continue;
        arena.boxes[i].at = {pose.position.x, pose.position.y, arena.boxes[i].at.z};
        arena.boxes[i].yaw = pose.heading;
    }
    for (std::size_t i = 0; i < arena.cylinders.size(); ++i) {
        if (thing_name("cylinder", i) != name) continue;
        arena.cylinders[i].at = {pose.position.x, pose.position.y, arena.cylinders[i].at.z};
    }
}

}  // namespace nezumi
