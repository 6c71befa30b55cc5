// Applies the measurements of one robot to its model.
#include "engine/world/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

namespace nezumi {
namespace {

// A measured length that differs from the model's by more than this factor is not plausible.
constexpr double most_off = 2;

}  // namespace

Expected<void> apply(const Calibration& calibration, RobotSpec& spec) {
    if (const WheelCalibration& wheels = calibration.odometry; wheels.is_there()) {
        const DriveSpec& model = spec.drive;
        for (const auto& [what, measured, told] :
             {std::tuple("track", wheels.track, model.track),
              std::tuple("left_radius", wheels.left_radius, model.radius_of_left()),
              std::tuple("right_radius", wheels.right_radius, model.radius_of_right())}) {
            if (measured > most_off * told || told > most_off * measured)
                return failure(
                    fmt::format("odometry.{} is {:g} m, but model '{}' has {:g} m: the calibration is of another "
                                "robot, or it is wrong. Calibrate it again with nezumi calibrate odometry",
                                what, measured, spec.model, told));
        }
        spec.drive.track = wheels.track;
        spec.drive.left_radius = wheels.left_radius;
        spec.drive.right_radius = wheels.right_radius;
        spec.drive.hardware_limits = spec.drive.limits;
    }
    for (const RangeCalibration& range : calibration.ranges) {
        const auto sensor = std::find_if(spec.sensors.begin(), spec.sensors.end(),
                                         [&](const SensorSpec& each) { return each.name == range.sensor; });
        if (sensor == spec.sensors.end() || sensor->kind != SensorSpec::Kind::range) {
            std::vector<std::string_view> names;
            for (const SensorSpec& each : spec.sensors) {
                if (each.kind == SensorSpec::Kind::range) names.push_back(each.name);
            }
            return failure(fmt::format("model '{}' has no range sensor '{}'{}", spec.model, shown(range.sensor),
                                       did_you_mean(range.sensor, names)));
        }
        auto response = sensor->response.with_points(range.points, sensor->range);
        if (!response) return failure(fmt::format("sensor '{}': {}", range.sensor, response.error().message));
        sensor->response = std::move(*response);
        sensor->has_response = true;
    }
    return {};
}

}  // namespace nezumi
