// A test rig: devices that observe real robots and know what a simulation knows of simulated robots.
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

/// A test rig. Its world has no objects of the arena, and never steps.
struct Rig {
    std::unique_ptr<World> world;     ///< none: it sees no robot
    std::vector<std::string> robots;  ///< the robots that it sees; the index is the id of the robot in its world

    std::optional<RobotId> find(std::string_view robot) const {
        const auto found = std::find(robots.begin(), robots.end(), robot);
        if (found == robots.end()) return std::nullopt;
        return static_cast<RobotId>(found - robots.begin());
    }
};

/// Makes the rig for a system. The robots are at the poses of the system's file. May be empty: then there is no rig.
using RigMaker = std::function<Expected<Rig>(const SystemSpec& spec)>;

}  // namespace nezumi
