// The motion of a robot's wheels in each tick, computed from its odometry.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/robot/robot.hpp"

namespace nezumi::hw {

/// Follows an odometry and computes the travel of both wheels since the last sample.
class TravelRecorder {
public:
    explicit TravelRecorder(const Robot& robot) : robot_(robot), last_(robot.odometry().pose()) {}

    void sample() {
        const Pose2D now = robot_.odometry().pose();
        const double turn = std::remainder(now.heading - last_.heading, 2 * std::numbers::pi),
                     middle = last_.heading + turn / 2;
        const double dx = now.position.x - last_.position.x, dy = now.position.y - last_.position.y;
        // Converts the chord to the length of the arc, to the third order; the turn within one tick is small.
        const double ahead = (dx * std::cos(middle) + dy * std::sin(middle)) / (1 - turn * turn / 24);
        const double half = turn * robot_.spec().drive.track / 2;
        travel_.push_back({.left = ahead - half, .right = ahead + half});
        last_ = now;
    }
    std::vector<Wheels> take() { return std::move(travel_); }

private:
    const Robot& robot_;
    Pose2D last_;
    std::vector<Wheels> travel_;
};

}  // namespace nezumi::hw
