// What stands beside real robots and knows of them what a world knows of those that it simulates.
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

/// A test rig. Its world has none of the arena's things, and never steps.
struct Rig {
    std::unique_ptr<World> world;     ///< none: it sees no robot
    std::vector<std::string> robots;  ///< that it sees; the index is the robot's id in its world

    std::optional<RobotId> find(std::string_view robot) const {
        const auto found = std::find(robots.begin(), robots.end(), robot);
        if (found == robots.end()) return std::nullopt;
        return static_cast<RobotId>(found - robots.begin());
    }
};

/// Makes the rig for a system, in which its robots stand where the system's file has them. May be empty: then nobody
/// sees real robots from outside.
using RigMaker = std::function<Expected<Rig>(const SystemSpec& spec)>;

}  // namespace nezumi
