// Wheel odometry: the pose of a robot, computed from the rotation of its wheels.
#pragma once

#include "engine/ports/messages.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Odometry {
public:
    /// Radii and track in m; `pulses_per_turn` of a wheel, more than 0.
    Odometry(double left_radius, double right_radius, double track, double pulses_per_turn);

    /// Adds the rotation of the wheels; `pulses` counts from the start. The first call only sets the zero.
    void update(const WheelPulses& pulses);
    /// The present pose; the heading is between -pi and pi.
    const Pose2D& pose() const { return pose_; }
    void start_at(const Pose2D& pose) { pose_ = pose; }
    void set_pose(const Pose2D& pose) {
        pose_ = pose;
        ++resets_;
    }
    /// How often the pose was set.
    int resets() const { return resets_; }

private:
    Wheels metres_per_pulse_;
    double track_;
    WheelPulses counted_{};
    bool started_ = false;
    int resets_ = 0;
    Pose2D pose_{};
};

}  // namespace nezumi
