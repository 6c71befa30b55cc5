// Slowly, a second for each: the left wheel forward and back, then the right one.
#include "bindings/cli/move_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "bindings/cli/travel_recorder.hpp"

namespace nezumi::cli {
namespace {

constexpr double rim_speed = 0.05;  // [m/s]
constexpr double seconds = 1;
constexpr double tolerance = 0.4;  // of the way: speeding up and braking are in it

hw::Finding judged(const std::string& what, double wanted, double own, double other) {
    using enum hw::Finding::State;
    const std::string found = fmt::format("{}: {:.3f} m counted, {:.3f} m expected", what, own, wanted);
    if (std::abs(own - wanted) > tolerance * std::abs(wanted))
        return {"wheels", wrong, found,
                std::abs(own) < 0.1 * std::abs(wanted)
                    ? "its counter or its motor is not connected: look at their cables"
                    : "look at its motor's cables: left and right, or forward and backward, are exchanged"};
    if (std::abs(other) > tolerance * std::abs(wanted))
        return {"wheels", wrong, fmt::format("{}: the other wheel turned by {:.3f} m", what, other),
                "look at the motors' cables: left and right are exchanged"};
    return {"wheels", good, found, ""};
}

}  // namespace

Expected<hw::Findings> check_moves(GuidedRobot& robot, Person& person) {
    if (auto there = person.is_there(); !there) return Unexpected(there.error());
    if (auto ok = person.confirm("The wheels are going to turn: hold the robot so that they touch nothing."); !ok)
        return Unexpected(ok.error());
    hw::Findings findings;
    const double track = robot.robot().spec().drive.track;
    for (const bool is_left : {true, false}) {
        for (const bool is_forward : {true, false}) {
            const double speed = is_forward ? rim_speed : -rim_speed;
            // The other wheel stands: the robot would turn about it.
            const Velocity2D velocity{.vx = speed / 2, .va = (is_left ? -speed : speed) / track};
            const std::string what =
                fmt::format("{} wheel {}", is_left ? "left" : "right", is_forward ? "forward" : "backward");
            person.tell(what);
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
    person.tell("Did each wheel turn as it was said? The counters see what the motors are told, not what they do.");
    return findings;
}

}  // namespace nezumi::cli
