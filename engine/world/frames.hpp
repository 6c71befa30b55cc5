// Poses on the floor in frames other than the world's.
#pragma once

#include "engine/ports/messages.hpp"

namespace nezumi {

/// A point or velocity turned about the origin, counter-clockwise [rad].
Point2D turned(const Point2D& point, double angle);

/// `pose` in the frame that has its origin at `frame`, both given in one other frame. The heading lies between -pi and
/// pi.
Pose2D seen_from(const Pose2D& frame, const Pose2D& pose);
/// The inverse: where `frame` is given, the pose that is `pose` in it.
Pose2D placed_at(const Pose2D& frame, const Pose2D& pose);

}  // namespace nezumi
