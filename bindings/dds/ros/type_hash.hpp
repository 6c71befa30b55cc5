// Computes how ROS 2 identifies a message type: the name in DDS, and the hash of the definition.
#pragma once

#include <string>
#include <string_view>

#include "engine/values/type.hpp"

namespace nezumi::ros {

/// Converts "geometry_msgs/msg/Twist" to its DDS name "geometry_msgs::msg::dds_::Twist_".
std::string dds_type_name(std::string_view name);

/// The hash by which ROS 2 since Iron distinguishes definitions (ROS Interface Hashing Standard, version 1). ROS has no
/// enumerations: they are numbers of 32 bits there, as on the wire.
std::string type_hash(const Type& type);

}  // namespace nezumi::ros
