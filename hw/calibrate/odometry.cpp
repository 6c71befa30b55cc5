// Reads the motion of the wheels from the odometry in each tick, so that the fit can repeat it with other wheel
// parameters.
#include "hw/calibrate/odometry.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "hw/calibrate/guided_moves.hpp"
#include "hw/calibrate/travel_recorder.hpp"

namespace nezumi::hw {
WheelCalibration wheels_of(const DriveSpec& drive) {
    return {.track = drive.track, .left_radius = drive.radius_of_left(), .right_radius = drive.radius_of_right()};
}

Expected<WheelFit> calibrate_odometry(GuidedRobot& robot, const OdometryCourse& course, const CourseHelp& help) {
    const Pace pace{.speed = course.speed, .yaw_rate = course.yaw_rate};
    std::vector<MeasuredDrive> drives;
    const auto measure = [&](const std::string& name, auto drive) -> Expected<void> {
        robot.rest();
        if (auto placed = help.place(name); !placed) return placed;
        TravelRecorder recorder(robot.robot());
        if (auto driven = drive([&] { recorder.sample(); }); !driven) return driven;
        robot.rest();
        recorder.sample();  // the rest of the braking
        auto end = help.measure(name);
        if (!end) return Unexpected(end.error());
        drives.push_back({.travel = recorder.take(), .end = *end});
        return {};
    };
    auto straight = measure(fmt::format("a straight line of {} m", 2 * course.side),
                            [&](const GuidedRobot::EachTick& each) { return go(robot, 2 * course.side, pace, each); });
    if (!straight) return Unexpected(straight.error());
    for (const auto& [name, side] : {std::pair{"left", 1.0}, {"right", -1.0}}) {
        auto square = measure(fmt::format("a square of {} m to the {}", course.side, name),
                              [&, side = side](const GuidedRobot::EachTick& each) -> Expected<void> {
                                  for (int corner = 0; corner < 4; ++corner) {
                                      if (auto ok = go(robot, course.side, pace, each); !ok) return ok;
                                      if (auto ok = turn(robot, side * std::numbers::pi / 2, pace, each); !ok)
                                          return ok;
                                  }
                                  return {};
                              });
        if (!square) return Unexpected(square.error());
    }
    return fit_wheels(drives, wheels_of(robot.robot().spec().drive));
}

}  // namespace nezumi::hw
