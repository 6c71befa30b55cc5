// What ROS 2 calls a message type: its name in DDS, and the hash of its definition, both from its description.
#pragma once

#include <string>
#include <string_view>

#include "engine/values/type.hpp"

namespace nezumi::ros {

/// "geometry_msgs/msg/Twist" as DDS knows it: "geometry_msgs::msg::dds_::Twist_".
std::string dds_type_name(std::string_view name);

/// The hash by which tools of ROS 2 since Iron tell definitions apart (ROS Interface Hashing Standard, version 1).
std::string type_hash(const Type& type);

}  // namespace nezumi::ros
