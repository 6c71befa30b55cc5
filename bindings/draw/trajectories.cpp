// A point is stored if it is far enough from the one before. With too many points, every second one is removed.
#include "bindings/draw/trajectories.hpp"

#include <cmath>

namespace nezumi::draw {
namespace {

Point2D latest_of(const Channel& position) {
    double coordinates[2] = {};
    std::size_t count = 0;
    position.visit_latest([&](const LeafPath&, const ValueView& leaf) { coordinates[count++] = leaf.as<double>(); });
    return {coordinates[0], coordinates[1]};
}

}  // namespace

void Trajectories::add(const System& system, Trace& trace) {
    for (const Robot* robot : system.robots()) {
        if (robot->is_real()) continue;  // its true pose is unknown
        auto known = by_robot_.find(robot->name());
        if (known == by_robot_.end()) {
            const auto position = trace.follow(robot->name() + ".truth.pose.position");
            if (!position) continue;
            known = by_robot_.emplace(robot->name(), Trajectory{*position}).first;
        }
        auto& [position, points, apart] = known->second;
        const Point2D here = latest_of(*position);
        if (!points.empty() && std::hypot(here.x - points.back().x, here.y - points.back().y) < apart) continue;
        points.push_back(here);
        if (points.size() < most_points) continue;
        for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
        points.resize(points.size() / 2);
        apart *= 2;
    }
}

const std::vector<Point2D>& Trajectories::of(std::string_view robot) const {
    static const std::vector<Point2D> none;
    const auto known = by_robot_.find(robot);
    return known != by_robot_.end() ? known->second.points : none;
}

}  // namespace nezumi::draw
