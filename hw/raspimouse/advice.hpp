// Advice on nodes of the mouse that do not work.
#pragma once

#include <string>
#include <string_view>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// "/dev/rtled0: no such file or directory: is the driver loaded? Try: sudo modprobe rtmouse".
std::string with_advice(const NodeError& error);

/// The line of config.txt without which the light sensors give only zeros, since Linux 5.16.
inline constexpr std::string_view light_sensor_overlay =
    "dtoverlay=anyspi:spi0-0,dev=\"microchip,mcp3204\",speed=500000";

/// The message for a node whose text does not have the driver's format.
std::string not_understood(const Node& node, std::string_view said, std::string_view expected);

}  // namespace nezumi::hw
