// Reads anything as a robot file: what comes out is sound, or an error that is one line with a place.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "bindings/lua/files/robot_file.hpp"
#include "engine/robot/robot.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

void check(const RobotSpec& robot) {
    require(is_positive(robot.mass) && is_positive(robot.drive.radius) && is_positive(robot.drive.track) &&
            is_positive(robot.drive.skid));
    require(is_positive(robot.body.size.x) && is_positive(robot.body.size.y) && is_positive(robot.body.size.z));
    for (const SensorSpec& sensor : robot.sensors) {
        require(is_finite(sensor.at) && std::isfinite(sensor.yaw) && is_positive(sensor.range) && sensor.noise >= 0 &&
                sensor.rays > 0);
        if (!sensor.has_response) continue;
        for (const double distance : {0.0, 1e-9, 0.01, 0.3, 0.6, 1e9, std::numeric_limits<double>::infinity()}) {
            require(std::isfinite(sensor.response(distance)));
        }
    }
    require(Robot::make("any", robot, robot.drive.limits).has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Project project = Project::of("engine/robots/any.lua", {"."});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto robot = read_robot_text(text, "engine/robots/any.lua", project);
    robot ? check(*robot) : check(robot.error());
    return 0;
}
