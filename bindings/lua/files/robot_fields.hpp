// Reads the fields of a robot file into a robot's description.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/records/fields.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// Functions for parts of a description that are outside of its table.
struct RobotFileHelp {
    /// Reads the points of a response table from `file`, which is searched beside the robot file that sets `path`.
    std::function<Expected<std::vector<ResponseTable::Point>>(const FieldPath& path, const std::string& file)>
        read_table;
    /// Calls the function at `path` of the robot file's table with each of these distances [m]. Returns the results,
    /// which may be infinite.
    std::function<Expected<std::vector<double>>(const FieldPath& path, const std::vector<double>& distances)> call;
    /// The names of all drivers of real robots; empty: unknown, so every name is accepted.
    std::vector<std::string> drivers = {};
    /// Finds the file of the behaviour `name`, which is searched beside the robot file that sets `path`.
    std::function<Expected<std::string>(const FieldPath& path, const std::string& name)> find_script = {};
};

/// The number of samples of a response function.
inline constexpr std::size_t response_samples = 1024;

/// Reads the table of `robot_model`. Mistakes go to `check`; then the result must not be used. Without a body, the
/// robot is a box about as large as its track. Unless the file has other ports for target velocity, odometry and
/// measured velocity, the robot has those of the Raspberry Pi Mouse.
RobotSpec read_robot_fields(FieldCheck& check, const Value& value, const RobotFileHelp& help);

/// Reads the sensor with this name. Its position is relative to the centre of `body`.
SensorSpec read_sensor_fields(const std::string& name, Fields& sensor, const BodySpec& body, const RobotFileHelp& help);

/// Points of a response, `{ { 0.01, 1394 }, { 0.02, 792 } }`, from the field 'table' of a sensor.
std::vector<ResponseTable::Point> read_points(Fields& sensor, const FileTable& table);

/// Converts a position relative to the hull's centre to the body frame.
Point3D on_body(const BodySpec& body, const Point3D& at);

}  // namespace nezumi
