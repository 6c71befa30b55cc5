// The table of a robot file, field by field, as a robot's description.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bindings/lua/files/file_fields.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// What the description needs from outside its table.
struct RobotFileHelp {
    /// The points of the table in this file, looked up beside the file that names it at this path.
    std::function<Expected<std::vector<ResponseTable::Point>>(const FieldPath& path, const std::string& file)>
        read_table;
    /// What the function at this path of the table returns for each of these distances [m]. Infinite values are let
    /// through.
    std::function<Expected<std::vector<double>>(const FieldPath& path, const std::vector<double>& distances)> call;
    /// The drivers of real robots that there are; empty: nobody knows, and every name is let through.
    std::vector<std::string> drivers = {};
};

/// How many values of a response function are taken.
inline constexpr std::size_t response_samples = 1024;

/// Reads the table given to `robot_model`. What is wrong is said to `check`; then the result is of no use. Without a
/// body the robot is a box about as large as its track; of target velocity, odometry and measured velocity the robot
/// has the Raspberry Pi Mouse's ports, unless the file gives it others for them.
RobotSpec read_robot_fields(FieldCheck& check, const Value& value, const RobotFileHelp& help);

/// One sensor of this name. Its place is given from the centre of `body`.
SensorSpec read_sensor_fields(const std::string& name, Fields& sensor, const BodySpec& body, const RobotFileHelp& help);

/// Points of a response in a file, `{ { 0.01, 1394 }, { 0.02, 792 } }`, the field 'table' of a sensor.
std::vector<ResponseTable::Point> read_points(Fields& sensor, const FileTable& table);

/// A place given from the hull's centre, in the body frame.
Point3D on_body(const BodySpec& body, const Point3D& at);

}  // namespace nezumi
