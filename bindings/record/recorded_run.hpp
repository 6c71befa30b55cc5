// The contents of nezumi's own recordings besides ports: the journal of the run, the log, values by name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/record/mcap_reader.hpp"
#include "engine/base/error.hpp"
#include "engine/base/log.hpp"
#include "engine/messages/ros_time.hpp"

namespace nezumi::record {

/// The topic of the journal: messages std_msgs/msg/String, each with some lines of the journal.
inline constexpr std::string_view journal_topic = "/nezumi/journal";
/// The topic of the log, as ROS names it: rcl_interfaces/msg/Log.
inline constexpr std::string_view log_topic = "/rosout";
/// The key in the metadata of a channel whose value is the name of the port, such as "mouse.ir_sensor_out".
inline constexpr std::string_view port_entry = "nezumi_port";

/// "mouse.ir_sensor_out" as a topic: "/mouse/ir_sensor_out".
std::string topic_of(std::string_view path);

/// Converts seconds to nanoseconds; negative numbers and NaN become 0.
std::uint64_t to_nanoseconds(double seconds);
/// The inverse of `to_nanoseconds`: a number of seconds with at most 9 decimals comes back exactly.
double to_seconds(std::uint64_t nanoseconds);

/// Numbers and texts by name, of parameters, of a script's state and of its probes. A boolean is 0 or 1.
struct NamedNumber {
    std::string name;
    double value = 0;
    static constexpr std::string_view type_name = "nezumi_msgs/msg/NamedNumber";
};
struct NamedText {
    std::string name;
    std::string value;
    static constexpr std::string_view type_name = "nezumi_msgs/msg/NamedText";
};
struct NamedValues {
    std::vector<NamedNumber> numbers;
    std::vector<NamedText> texts;
    static constexpr std::string_view type_name = "nezumi_msgs/msg/NamedValues";
};
struct RosLog {
    ros::Time stamp;
    std::uint8_t level = 0;
    std::string name;
    std::string msg;
    std::string file;
    std::string function;
    std::uint32_t line = 0;
    static constexpr std::string_view type_name = "rcl_interfaces/msg/Log";
};
struct RosString {
    std::string data;
    static constexpr std::string_view type_name = "std_msgs/msg/String";
};
/// A log line as rcl_interfaces/msg/Log. `tm` is its time in the recording [s].
RosLog to_ros(const LogLine& line, double tm);

/// The journal of the recorded run. An error if the file has none.
Expected<std::string> journal_of(const McapFile& recording, const std::string& name);

}  // namespace nezumi::record
