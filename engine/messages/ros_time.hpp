// The stamp of messages of ROS 2, with the fields of its public definition.
#pragma once

#include <cstdint>
#include <string_view>

namespace nezumi::ros {

struct Time {
    std::int32_t sec = 0;       ///< [s] whole seconds
    std::uint32_t nanosec = 0;  ///< [ns] the rest
    bool operator==(const Time&) const = default;

    static constexpr std::string_view type_name = "builtin_interfaces/msg/Time";
};

}  // namespace nezumi::ros
