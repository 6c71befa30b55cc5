// The trajectories of robots, thinned out: for pictures.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/trace/trace.hpp"

namespace nezumi::draw {

class Trajectories {
public:
    /// Adds where the simulated robots of the trace's system are; to be called after every tick. Robots that come later
    /// begin then.
    void add(const System& system, Trace& trace);
    /// Forgets all: the system has been started anew.
    void clear() { by_robot_.clear(); }

    /// Points [m] of a robot's trajectory, oldest first; empty when it has not been seen.
    const std::vector<Point2D>& of(std::string_view robot) const;

private:
    struct Trajectory {
        const Channel* position;
        std::vector<Point2D> points{};
        double apart = 0.002;  // [m] between two points; grows so that memory does not
    };

    static constexpr std::size_t most_points = 20000;  // of one robot

    std::map<std::string, Trajectory, std::less<>> by_robot_;
};

}  // namespace nezumi::draw
