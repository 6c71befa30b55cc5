// Turns each wheel slowly for one second each way: first left, then right.
#include "hw/calibrate/move_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hw/calibrate/travel_recorder.hpp"

namespace nezumi::hw {
namespace {

constexpr double rim_speed = 0.05;  // [m/s]
constexpr double seconds = 1;
constexpr double tolerance = 0.4;  // relative; large, because the way includes speeding up and braking

Finding judged(const std::string& what, double wanted, double own, double other) {
    using enum Finding::State;
    const std::string found = fmt::format("{}: {:.3f} m counted, {:.3f} m expected", what, own, wanted);
    if (std::abs(own - wanted) > tolerance * std::abs(wanted))
        return {"wheels", wrong, found,
                std::abs(own) < 0.1 * std::abs(wanted)
                    ? "the wheel's counter or motor is not connected: check the cables of both"
                    : "check the cables of the motors: left and right, or forward and backward, are swapped"};
    if (std::abs(other) > tolerance * std::abs(wanted))
        return {"wheels", wrong, fmt::format("{}: the other wheel turned by {:.3f} m", what, other),
                "check the cables of the motors: left and right are swapped"};
    return {"wheels", good, found, ""};
}

}  // namespace

Expected<Findings> check_moves(GuidedRobot& robot, const std::function<void(const std::string& text)>& tell) {
    Findings findings;
    const double track = robot.robot().spec().drive.track;
    for (const bool is_left : {true, false}) {
        for (const bool is_forward : {true, false}) {
            const double speed = is_forward ? rim_speed : -rim_speed;
            // The other wheel stands, so the robot would turn about it.
            const Velocity2D velocity{.vx = speed / 2, .va = (is_left ? -speed : speed) / track};
            const std::string what =
                fmt::format("{} wheel {}", is_left ? "left" : "right", is_forward ? "forward" : "backward");
            tell(what);
            TravelRecorder recorder(robot.robot());
            if (auto driven = robot.drive(velocity, seconds, {}, [&] { recorder.sample(); }); !driven)
                return Unexpected(driven.error());
            if (auto stood = robot.stand(0.2, [&] { recorder.sample(); }); !stood) return Unexpected(stood.error());
            Wheels sum;
            for (const Wheels& step : recorder.take()) {
                sum.left += step.left;
                sum.right += step.right;
            }
            findings.push_back(
                judged(what, speed * seconds, is_left ? sum.left : sum.right, is_left ? sum.right : sum.left));
        }
    }
    robot.rest();
    tell("Did each wheel turn as announced? The counters count the commands to the motors, not their motion.");
    return findings;
}

}  // namespace nezumi::hw
