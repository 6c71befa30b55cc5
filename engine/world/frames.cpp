// Don't reorder the additions: their rounding affects every trace hash.
#include "engine/world/frames.hpp"

#include <cmath>
#include <numbers>

namespace nezumi {
namespace {

double within_half_a_turn(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

Point2D turned(const Point2D& point, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * point.x - s * point.y, s * point.x + c * point.y};
}

Pose2D seen_from(const Pose2D& frame, const Pose2D& pose) {
    const Point2D away{pose.position.x - frame.position.x, pose.position.y - frame.position.y};
    return {.position = turned(away, -frame.heading), .heading = within_half_a_turn(pose.heading - frame.heading)};
}

Pose2D placed_at(const Pose2D& frame, const Pose2D& pose) {
    const double c = std::cos(frame.heading), s = std::sin(frame.heading);
    const Point2D &at = frame.position, &away = pose.position;
    return {.position = {at.x + c * away.x - s * away.y, at.y + s * away.x + c * away.y},
            .heading = within_half_a_turn(frame.heading + pose.heading)};
}

}  // namespace nezumi
