// Wheel odometry: where a robot thinks it is, from how far its wheels have turned.
#pragma once

#include "engine/ports/messages.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Odometry {
public:
    /// With `pulses_per_turn` > 0 the wheels' angles are counted in whole pulses, as an encoder does.
    Odometry(double left_radius, double right_radius, double track, double pulses_per_turn)
        : radius_{left_radius, right_radius}, track_(track), pulses_per_turn_(pulses_per_turn) {}

    /// Takes the angles [rad] that the wheels have turned since the start. The first call only sets the zero.
    void update(const Wheels& angles);
    const Pose2D& pose() const { return pose_; }
    void set_pose(const Pose2D& pose) { pose_ = pose; }

private:
    double counted(double angle) const;

    Wheels radius_;
    double track_;
    double pulses_per_turn_;
    Wheels counted_{};
    bool started_ = false;
    Pose2D pose_{};
};

}  // namespace nezumi
