// A point is kept when it is far enough from the one before; too many points: every other one goes.
#include "bindings/cli/trajectories.hpp"

#include <cmath>

namespace nezumi::cli {

void Paths::look(const System& system) {
    if (system.world() == nullptr) return;
    paths_.resize(system.robots().size());
    for (const Robot* robot : system.robots()) {
        if (robot->is_real()) continue;
        auto& [points, apart] = paths_[robot->id() < paths_.size() ? robot->id() : paths_.size() - 1];
        const Point2D here = system.world()->truth(robot->id()).pose.position;
        if (!points.empty() && std::hypot(here.x - points.back().x, here.y - points.back().y) < apart) continue;
        points.push_back(here);
        if (points.size() < kMostPoints) continue;
        for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
        points.resize(points.size() / 2);
        apart *= 2;
    }
}

const std::vector<Point2D>& Paths::of(std::size_t robot) const {
    static const std::vector<Point2D> none;
    return robot < paths_.size() ? paths_[robot].points : none;
}

}  // namespace nezumi::cli
