// A test rig: devices that observe real robots and measure what a simulation knows about its robots, such as the true
// poses.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

struct SystemSpec;

/// A test rig. Its world has no objects of the arena and no physics.
struct Rig {
    std::unique_ptr<World> world;     ///< null: the rig sees no robot
    std::vector<std::string> robots;  ///< the robots that the rig sees; the index is the robot's id in `world`

    std::optional<RobotId> find(std::string_view robot) const {
        const auto found = std::find(robots.begin(), robots.end(), robot);
        if (found == robots.end()) return std::nullopt;
        return static_cast<RobotId>(found - robots.begin());
    }
};

/// Makes the rig for a system, whose robots start at the poses of the system file. May be an empty function: then there
/// is no rig.
using RigMaker = std::function<Expected<Rig>(const SystemSpec& spec)>;

}  // namespace nezumi
