// Advice on nodes of the mouse that do not work.
#pragma once

#include <string>
#include <string_view>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// "/dev/rtled0: no such file or directory: is the driver loaded? Try: sudo modprobe rtmouse".
std::string with_mouse_advice(const NodeError& error);

/// The line of config.txt without which the light sensors give only zeros, since Linux 5.16.
inline constexpr std::string_view light_sensor_overlay =
    "dtoverlay=anyspi:spi0-0,dev=\"microchip,mcp3204\",speed=500000";

/// Advice for a driver that finds no counters, or for counters without values.
inline constexpr const char* counters_on_i2c =
    "Is dtparam=i2c_arm=on in config.txt, and do the addresses 0x10 and 0x11 answer (i2cdetect -y 1)?";

/// [Hz] The clock of the I2C bus that the counters' makers ask for.
inline constexpr unsigned counters_i2c_clock = 62500;

/// The error of a node with a text that its driver would not write.
std::string not_understood(const Node& node, std::string_view said, std::string_view expected);

}  // namespace nezumi::hw
