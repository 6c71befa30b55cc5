// The paths that robots have driven, thinned out: for pictures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/system/system.hpp"

namespace nezumi::cli {

class Paths {
public:
    /// Looks where the robots are; to be called after every tick. Robots that come later begin then.
    void look(const System& system);
    /// Forgets all: the system has been started anew.
    void clear() { paths_.clear(); }

    /// Points [m] of a robot's path, oldest first; empty when it has not been seen.
    const std::vector<Point2D>& of(std::size_t robot) const;

private:
    struct Path {
        std::vector<Point2D> points;
        double apart = 0.002;  // [m] between two points; grows so that memory does not
    };

    static constexpr std::size_t kMostPoints = 20000;  // of one robot

    std::vector<Path> paths_;  // by robot
};

}  // namespace nezumi::cli
