// Compares two motions since a common start, one relative to the other.
#include "engine/robot/twin.hpp"

#include "engine/robot/robot.hpp"
#include "engine/world/frames.hpp"

namespace nezumi {

Twin::Twin(const Robot& real, const World& world, RobotId id, OutPort<Pose2D>& error)
    : real_(&real), world_(world), id_(id), error_(error), servo_angles_(real.spec().actuators.size()) {}

void Twin::forget(const Component& gone) {
    if (real_ == &gone) real_ = nullptr;
}

void Twin::drive(RobotBody& body, bool is_active) {
    if (real_ == nullptr || !is_active) return body.set_wheel_speeds({});
    if (const auto& told = real_->told()) {
        body.set_wheel_speeds(*told);
    } else {
        body.coast();
    }
    for (std::size_t i = 0; i < servo_angles_.size(); ++i) {
        if (real_->spec().actuators[i].kind != ActuatorSpec::Kind::servo) continue;
        const double angle = real_->servo_angle(i);
        if (angle == servo_angles_[i]) continue;
        servo_angles_[i] = angle;
        body.aim_servo(i, angle, 0);
    }
}

void Twin::compare() {
    if (real_ == nullptr || !real_->measured_at()) return;
    const Odometry& odometry = real_->odometry();
    const Pose2D twin = world_.truth(id_).pose;
    if (!begin_ || begin_->resets != odometry.resets()) begin_ = Begin{odometry.pose(), twin, odometry.resets()};
    error_.write(seen_from(seen_from(begin_->twin, twin), seen_from(begin_->real, odometry.pose())));
    error_.stamp(*real_->measured_at());
}

}  // namespace nezumi
