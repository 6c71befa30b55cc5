// The trajectories of robots for pictures, with a limited number of points.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/trace/trace.hpp"

namespace nezumi::draw {

class Trajectories {
public:
    /// Adds the present positions of simulated robots. Call this after every tick. The trajectory of a robot that is
    /// added later starts when it is added.
    void add(const System& system, Trace& trace);
    /// Removes all trajectories. Call this after a restart of the system.
    void clear() { by_robot_.clear(); }

    /// Points [m] of a robot's trajectory, oldest first; empty if the robot is unknown.
    const std::vector<Point2D>& of(std::string_view robot) const;

private:
    struct Trajectory {
        const Channel* position;
        std::vector<Point2D> points{};
        double apart = 0.002;  // [m] distance of two points; increases to limit the memory
    };

    static constexpr std::size_t most_points = 20000;  // of one robot

    std::map<std::string, Trajectory, std::less<>> by_robot_;
};

}  // namespace nezumi::draw
