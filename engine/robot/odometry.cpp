// Exact integration of an arc: ds = (dR + dL) / 2, dth = (dR - dL) / track, constant over the interval.
#include "engine/robot/odometry.hpp"

#include <cmath>
#include <numbers>

namespace nezumi {

Odometry::Odometry(double left_radius, double right_radius, double track, double pulses_per_turn)
    : metres_per_pulse_{2 * std::numbers::pi * left_radius / pulses_per_turn,
                        2 * std::numbers::pi * right_radius / pulses_per_turn},
      track_(track) {}

void Odometry::update(const WheelPulses& pulses) {
    if (!started_) {
        started_ = true;
        counted_ = pulses;
        return;
    }
    // The difference of whole numbers is exact, also after a thousand kilometres.
    const double left = static_cast<double>(pulses.left - counted_.left) * metres_per_pulse_.left;
    const double right = static_cast<double>(pulses.right - counted_.right) * metres_per_pulse_.right;
    counted_ = pulses;
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
    pose_.heading = std::remainder(th + dth, 2 * std::numbers::pi);
}

}  // namespace nezumi
