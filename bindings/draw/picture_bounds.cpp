// Computes bounds from corners and paths, after values that are not finite have been removed.
#include "bindings/draw/picture_bounds.hpp"

#include <cmath>
#include <utility>

namespace nezumi::draw {

// The convex hull of the box's corners (Andrew's monotone chain).
std::vector<Point2D> outline(const ThingPose& thing) {
    const auto& [r, p, y] = thing.pose.orientation;
    const double cr = std::cos(r), sr = std::sin(r), cp = std::cos(p), sp = std::sin(p), cy = std::cos(y),
                 sy = std::sin(y);
    std::vector<Point2D> corners;
    for (int i = 0; i < 8; ++i) {
        const double a = thing.size.x / 2 * ((i & 1) != 0 ? 1 : -1);
        const double b = thing.size.y / 2 * ((i & 2) != 0 ? 1 : -1);
        const double c = thing.size.z / 2 * ((i & 4) != 0 ? 1 : -1);
        corners.push_back(
            {thing.pose.position.x + cy * cp * a + (cy * sp * sr - sy * cr) * b + (cy * sp * cr + sy * sr) * c,
             thing.pose.position.y + sy * cp * a + (sy * sp * sr + cy * cr) * b + (sy * sp * cr - cy * sr) * c});
    }
    std::sort(corners.begin(), corners.end(), [](const Point2D& one, const Point2D& other) {
        return std::pair(one.x, one.y) < std::pair(other.x, other.y);
    });
    std::vector<Point2D> hull;
    const auto add = [&hull](const Point2D& next, std::size_t least) {
        const auto turns_right = [&] {
            const Point2D &a = hull[hull.size() - 2], &b = hull.back();
            return (b.x - a.x) * (next.y - a.y) - (b.y - a.y) * (next.x - a.x) <= 1e-12;
        };
        while (hull.size() > least && turns_right()) hull.pop_back();
        hull.push_back(next);
    };
    for (const Point2D& corner : corners) add(corner, 1);
    const std::size_t lower = hull.size();
    for (auto corner = corners.rbegin() + 1; corner != corners.rend(); ++corner) add(*corner, lower);
    hull.pop_back();
    return hull;
}

PictureOf only_finite(PictureOf picture) {
    std::erase_if(picture.things, [](const ThingPose& thing) {
        const auto& [position, orientation] = thing.pose;
        return !std::isfinite(position.x + position.y + position.z + orientation.r + orientation.p + orientation.y);
    });
    std::erase_if(picture.robots, [](const PictureOf::Robot& robot) {
        return !std::isfinite(robot.pose.position.x + robot.pose.position.y + robot.pose.heading);
    });
    for (PictureOf::Robot& robot : picture.robots) {
        std::erase_if(robot.path, [](const Point2D& point) { return !std::isfinite(point.x + point.y); });
        std::erase_if(robot.rays,
                      [](const Ray& ray) { return !std::isfinite(ray.from.x + ray.from.y + ray.to.x + ray.to.y); });
    }
    return picture;
}

Bounds bounds_of(const PictureOf& picture) {
    Bounds bounds;
    for (const ThingPose& thing : picture.things) {
        if (thing.shape == ThingPose::Shape::cylinder) {
            bounds.include(thing.pose.position.x, thing.pose.position.y, thing.size.x / 2);
        } else {
            for (const Point2D& corner : outline(thing)) bounds.include(corner.x, corner.y, 0);
        }
    }
    for (const PictureOf::Robot& robot : picture.robots) {
        bounds.include(robot.pose.position.x, robot.pose.position.y,
                       std::hypot(robot.body.size.x, robot.body.size.y) / 2);
        for (const Point2D& point : robot.path) bounds.include(point.x, point.y, robot.body.size.y / 2);
    }
    if (picture.floor) {
        const Point2D half{picture.floor->size.x / 2, picture.floor->size.y / 2};
        bounds.include(half.x, half.y, 0);
        bounds.include(-half.x, -half.y, 0);
    }
    if (bounds.left > bounds.right) bounds.include(0, 0, 0.5);
    return bounds;
}

}  // namespace nezumi::draw
