// From a model to one robot of it.
#include "engine/world/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace nezumi {

Expected<void> apply(const Calibration& calibration, RobotSpec& spec) {
    if (const WheelCalibration& wheels = calibration.odometry; wheels.is_there()) {
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
