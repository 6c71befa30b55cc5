// The twin of a real robot: a simulated robot that gets the same commands.
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
    /// `real` must outlive this object or be forgotten. `world`, which has the twin as `id`, and `error` must outlive
    /// it.
    Twin(const Robot& real, const World& world, RobotId id, OutPort<Pose2D>& error);

    /// The real robot; nullptr if it is gone.
    const Robot* real() const { return real_; }
    /// Call this before the component `gone` is destroyed. If `gone` is the real robot, the twin then stands still.
    void forget(const Component& gone);

    /// Gives the wheels of the twin's body the commands of the real ones, after all safety limits, and moves its servos
    /// to the angles of the real ones. While the twin is not ACTIVE, it stands.
    void drive(RobotBody& body, bool is_active);
    /// Publishes the pose of the real robot (by its odometry) relative to the twin, at the time of the wheels' reading:
    /// x [m] forward, y [m] left, heading counter-clockwise in -pi to pi. Publishes nothing without odometry. Starts at
    /// the first call after `begin_anew`, and again when the odometry is set.
    void compare();
    void begin_anew() { begin_.reset(); }

private:
    // The poses of both robots when the comparison began.
    struct Begin {
        Pose2D real, twin;
        int resets;  // of the odometry
    };

    const Robot* real_;
    const World& world_;
    RobotId id_;
    OutPort<Pose2D>& error_;
    std::optional<Begin> begin_;
    std::vector<double> servo_angles_;  // [rad] by actuator, of the last command
};

}  // namespace nezumi
