// The twin of a real robot: what a simulated robot does that moves as the real one is told to.
#pragma once

#include <optional>
#include <vector>

#include "engine/ports/port.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Component;
class Robot;

class Twin {
public:
    /// `real` must outlive this or be forgotten, `world`, which has the twin as `id`, and `error` must outlive it.
    Twin(const Robot& real, const World& world, RobotId id, OutPort<Pose2D>& error);

    /// The real robot; nullptr when it is gone.
    const Robot* real() const { return real_; }
    /// Knows the real robot no longer, when this is it: the twin stands then.
    void forget(const Component& gone);

    /// Has the wheels of the twin's body do what the real ones were told, after all that made these safe, and its
    /// servos go where the real ones are. While the twin is not ACTIVE it stands.
    void drive(RobotBody& body, bool is_active);
    /// Publishes the real robot's pose by its odometry as its twin sees it, at the time when the wheels were read:
    /// x [m] ahead, y [m] to the left, the heading counter-clockwise in -pi to pi. Silent while the odometry is. Counts
    /// from the first call after `begin_anew`, and from where somebody sets the odometry.
    void compare();
    void begin_anew() { begin_.reset(); }

private:
    // Where both were when they counted as being in the same place.
    struct Begin {
        Pose2D real, twin;
        int resets;  // of the odometry
    };

    const Robot* real_;
    const World& world_;
    RobotId id_;
    OutPort<Pose2D>& error_;
    std::optional<Begin> begin_;
    std::vector<double> servo_angles_;  // [rad] by actuator, as told last
};

}  // namespace nezumi
