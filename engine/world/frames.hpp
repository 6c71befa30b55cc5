// Converts poses on the floor between frames.
#pragma once

#include "engine/ports/messages.hpp"

namespace nezumi {

/// A point or velocity, rotated about the origin, counter-clockwise [rad].
Point2D turned(const Point2D& point, double angle);

/// `pose` relative to `frame`; both are given in the same third frame. The heading is between -pi and pi.
Pose2D seen_from(const Pose2D& frame, const Pose2D& pose);
/// The inverse: the pose that is `pose` relative to `frame`, in the frame in which `frame` is given.
Pose2D placed_at(const Pose2D& frame, const Pose2D& pose);

}  // namespace nezumi
