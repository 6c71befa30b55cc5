// Braking starts v^2 / 2a before the goal.
#include "hw/calibrate/guided_moves.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace nezumi::hw {
namespace {

constexpr double least_move = 5e-4;  // [m], [rad]: smaller moves are below one pulse of a stepping motor
constexpr double move_patience = 2;  // a move fails after this multiple of its planned time plus two seconds

// `moved` returns how far the robot has moved, in the unit of `amount`.
Expected<void> move(GuidedRobot& robot, double amount, double fastest, double limit, double deceleration,
                    const std::function<Velocity2D(double signed_speed)>& velocity,
                    const std::function<double()>& moved, const GuidedRobot::EachTick& each_tick) {
    if (std::abs(amount) < least_move) return {};
    const double size = std::abs(amount);
    // At most the speed from which the robot can stop within half of the move.
    const double speed = std::min({fastest, limit, std::sqrt(size * deceleration)});
    const double braking = speed * speed / (2 * deceleration);
    const double seconds = move_patience * (size / speed + speed / deceleration) + 2;
    bool is_there = false;
    auto driven = robot.drive(
        velocity(std::copysign(speed, amount)), seconds,
        [&] {
            is_there = moved() >= size - braking;
            return is_there;
        },
        each_tick);
    if (!driven) return driven;
    if (is_there) return {};
    robot.rest();
    return failure("the robot does not move as commanded: run nezumi doctor, and check its wheel counters");
}

}  // namespace

Expected<void> go(GuidedRobot& robot, double distance, const Pace& pace, const GuidedRobot::EachTick& each_tick) {
    const Limits& limits = robot.robot().guard().limits();
    const Point2D start = robot.robot().odometry().pose().position;
    return move(
        robot, distance, pace.speed, limits.speed, limits.acceleration,
        [](double speed) { return Velocity2D{.vx = speed}; },
        [&] {
            const Point2D now = robot.robot().odometry().pose().position;
            return std::hypot(now.x - start.x, now.y - start.y);
        },
        each_tick);
}

Expected<void> turn(GuidedRobot& robot, double angle, const Pace& pace, const GuidedRobot::EachTick& each_tick) {
    const Limits& limits = robot.robot().guard().limits();
    double latest = robot.robot().odometry().pose().heading, turned = 0;
    return move(
        robot, angle, pace.yaw_rate, limits.yaw_rate, limits.yaw_acceleration,
        [](double rate) { return Velocity2D{.va = rate}; },
        [&] {
            // The heading is wrapped to one turn; its steps are small.
            const double heading = robot.robot().odometry().pose().heading;
            turned += std::remainder(heading - std::exchange(latest, heading), 2 * std::numbers::pi);
            return std::abs(turned);
        },
        each_tick);
}

}  // namespace nezumi::hw
