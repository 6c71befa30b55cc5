// Exact integration of an arc: ds = (dR + dL) / 2, dth = (dR - dL) / track, constant over the interval.
#include "engine/robot/odometry.hpp"

#include <cmath>
#include <numbers>

namespace nezumi {

double Odometry::counted(double angle) const {
    if (pulses_per_turn_ <= 0) return angle;
    const double pulse = 2 * std::numbers::pi / pulses_per_turn_;
    return std::floor(angle / pulse + 0.5) * pulse;
}

void Odometry::update(const Wheels& angles) {
    const Wheels now{counted(angles.left), counted(angles.right)};
    if (!started_) {
        started_ = true;
        counted_ = now;
        return;
    }
    const double left = (now.left - counted_.left) * radius_.left;
    const double right = (now.right - counted_.right) * radius_.right;
    counted_ = now;
    const double ds = (right + left) / 2;
    const double dth = (right - left) / track_;
    const double th = pose_.heading;
    if (std::abs(dth) < 1e-6) {
        pose_.position.x += ds * std::cos(th);
        pose_.position.y += ds * std::sin(th);
    } else {
        pose_.position.x += ds / dth * (std::sin(th + dth) - std::sin(th));
        pose_.position.y -= ds / dth * (std::cos(th + dth) - std::cos(th));
    }
    pose_.heading += dth;
}

}  // namespace nezumi
