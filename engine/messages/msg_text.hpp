// Writes message types as definitions of ROS 2, for recordings that other programs read.
#pragma once

#include <string>
#include <string_view>

#include "engine/values/type.hpp"

namespace nezumi {

/// The name of a structure in ROS: of a message that a file defines, the name that the file gives it, as
/// "my_msgs/msg/Obstacle"; else the structure's own.
std::string_view ros_name(const Type& type);

/// `ros_name`, with the package `nezumi_msgs` if it has none: "nezumi_msgs/msg/Point2D".
std::string full_ros_name(const Type& type);

/// The definition of a structure as its .msg file, then those of all structures in it, as MCAP wants them
/// ("ros2msg": 80 times =, and "MSG: geometry_msgs/Point" before each). ROS has no enumerations: they are uint32 with
/// constants. It has no sequences of sequences: the inner one becomes the field `values` of a message, which has the
/// same bytes in CDR.
std::string msg_text(const Type& type);

}  // namespace nezumi
