// Writes message types as definitions of ROS 2, for recordings that other programs read.
#pragma once

#include <string>
#include <string_view>

#include "engine/values/type.hpp"

namespace nezumi {

/// The name of a structure in ROS: the name for ROS in the file that defines the message, such as
/// "my_msgs/msg/Obstacle"; if there is none, the name of the structure.
std::string_view ros_name(const Type& type);

/// `ros_name` if it contains "/msg/"; otherwise its last part in the package `nezumi_msgs`: "nezumi_msgs/msg/Point2D".
std::string full_ros_name(const Type& type);

/// The definition of a structure as in a .msg file, then those of all structures in it, in the form that MCAP requires
/// ("ros2msg": 80 times =, and "MSG: geometry_msgs/Point" before each). ROS has no enumerations: they become uint32
/// with constants. ROS has no sequences of sequences: the inner one becomes the field `values` of a message, which has
/// the same bytes in CDR.
std::string msg_text(const Type& type);

}  // namespace nezumi
