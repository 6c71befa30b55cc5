// A sensor that is mounted at an angle faces the wall at a right angle when the robot has turned by the opposite angle.
#include "hw/calibrate/ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "engine/world/frames.hpp"
#include "hw/calibrate/guided_moves.hpp"

namespace nezumi::hw {
namespace {

constexpr std::array distances{0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.10, 0.12, 0.15, 0.20, 0.25, 0.30};  // [m]
constexpr double least_clearance = 0.004;  // [m] between hull and wall
constexpr double widest_angle = std::numbers::pi / 3;
constexpr Pace pace{.speed = 0.05, .yaw_rate = 0.5};

// The distance [m] by which a point of the body is ahead of the axle at this heading.
double ahead(double x, double y, double heading) { return x * std::cos(heading) - y * std::sin(heading); }

// The distance [m] by which the hull extends ahead of the axle.
double reach_of_hull(const BodySpec& body, double heading) {
    if (body.shape == BodySpec::Shape::cylinder) return ahead(body.at.x, body.at.y, heading) + body.size.x / 2;
    double reach = 0;
    for (const double x : {-body.size.x / 2, body.size.x / 2}) {
        for (const double y : {-body.size.y / 2, body.size.y / 2})
            reach = std::max(reach, ahead(body.at.x + x, body.at.y + y, heading));
    }
    return reach;
}

class Course {
public:
    Course(GuidedRobot& robot, const RangeCourse& course)
        : robot_(robot), course_(course), spec_(robot.robot().spec()), start_(robot.robot().odometry().pose()) {}

    Expected<std::vector<RangeCalibration>> drive() {
        // First the sensors that face straight ahead, because the robot already faces the wall.
        std::map<double, std::vector<std::size_t>> by_angle;
        for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
            const SensorSpec& sensor = spec_.sensors[i];
            if (sensor.kind == SensorSpec::Kind::range && sensor.on.empty() && std::abs(sensor.yaw) <= widest_angle)
                by_angle[sensor.yaw].push_back(i);
        }
        if (by_angle.empty()) return failure("this robot has no range sensors that face ahead");
        std::vector<std::pair<double, std::vector<std::size_t>>> groups(by_angle.begin(), by_angle.end());
        std::stable_sort(groups.begin(), groups.end(),
                         [](const auto& a, const auto& b) { return std::abs(a.first) < std::abs(b.first); });
        for (const auto& [angle, sensors] : groups) {
            if (auto ok = look_at_wall(-angle, sensors); !ok) return Unexpected(ok.error());
        }
        std::vector<RangeCalibration> all;
        for (auto& [index, points] : points_) {
            const std::string& name = spec_.sensors[index].name;
            if (points.size() < 2)
                return failure(fmt::format("sensor '{}' gives no readings: run nezumi doctor", name));
            std::sort(points.begin(), points.end(),
                      [](const auto& a, const auto& b) { return a.distance < b.distance; });
            all.push_back({name, std::move(points)});
        }
        return all;
    }

private:
    Pose2D pose() const { return seen_from(start_, robot_.robot().odometry().pose()); }
    // The distance [m] from a sensor along its ray to the wall.
    double distance_of(const SensorSpec& sensor) const {
        const Pose2D now = pose();
        const double clear = course_.wall - now.position.x - ahead(sensor.at.x, sensor.at.y, now.heading);
        return clear / std::cos(now.heading + sensor.yaw);
    }

    Expected<void> look_at_wall(double heading, const std::vector<std::size_t>& sensors) {
        const SensorSpec& first = spec_.sensors[sensors.front()];
        const double reach = reach_of_hull(spec_.body, heading), at = ahead(first.at.x, first.at.y, heading);
        // Backs away first, because turning needs room.
        if (heading != 0) {
            const double room = std::hypot(spec_.body.size.x, spec_.body.size.y);
            if (auto ok = back_off(course_.wall - room); !ok) return ok;
        }
        if (auto ok = turn(robot_, heading - pose().heading, pace); !ok) return ok;
        for (const double distance : distances) {
            if (distance > first.range || distance - reach + at < least_clearance) continue;
            const double x = course_.wall - distance - at;
            if (auto ok = go(robot_, (x - pose().position.x) / std::cos(heading), pace); !ok) return ok;
            if (auto ok = look(sensors); !ok) return ok;
        }
        return {};
    }
    Expected<void> back_off(double x) {
        const Pose2D now = pose();
        return x < now.position.x ? go(robot_, (x - now.position.x) / std::cos(now.heading), pace) : Expected<void>();
    }

    Expected<void> look(const std::vector<std::size_t>& sensors) {
        if (auto ok = robot_.stand(course_.settling); !ok) return ok;
        std::vector<double> sums(sensors.size());
        std::vector<int> counts(sensors.size());
        auto stood = robot_.stand(course_.looking, [&] {
            const auto readings = robot_.robot().readings();
            for (std::size_t i = 0; i < sensors.size(); ++i) {
                if (!readings[sensors[i]].is_there) continue;
                sums[i] += readings[sensors[i]].value;
                ++counts[i];
            }
        });
        if (!stood) return stood;
        for (std::size_t i = 0; i < sensors.size(); ++i) {
            if (counts[i] == 0) continue;
            points_[sensors[i]].push_back({distance_of(spec_.sensors[sensors[i]]), sums[i] / counts[i]});
        }
        return {};
    }

    GuidedRobot& robot_;
    const RangeCourse& course_;
    const RobotSpec& spec_;
    const Pose2D start_;
    std::map<std::size_t, std::vector<ResponseTable::Point>> points_;  // by sensor
};

}  // namespace

Expected<std::vector<RangeCalibration>> calibrate_ranges(GuidedRobot& robot, const RangeCourse& course) {
    return Course(robot, course).drive();
}

}  // namespace nezumi::hw
