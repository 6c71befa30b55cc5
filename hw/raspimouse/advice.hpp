// Error messages for device files of the mouse that do not work, with advice.
#pragma once

#include <string>
#include <string_view>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// Describes an error with advice: "/dev/rtled0: no such file or directory: is the driver loaded? Try: sudo modprobe
/// rtmouse".
std::string with_mouse_advice(const NodeError& error);

/// A line of config.txt: since Linux 5.16, the light sensors give only zeros without it.
inline constexpr std::string_view light_sensor_overlay =
    "dtoverlay=anyspi:spi0-0,dev=\"microchip,mcp3204\",speed=500000";

/// Advice if the kernel's driver finds no counters, or if the counters give no values.
inline constexpr const char* counters_on_i2c =
    "Is dtparam=i2c_arm=on in config.txt, and do the addresses 0x10 and 0x11 answer (i2cdetect -y 1)?";

/// [Hz] The clock of the I2C bus that the manufacturer of the counters requires.
inline constexpr unsigned counters_i2c_clock = 62500;

/// The error if a device file contains a text that the mouse's driver never writes.
std::string not_understood(const Node& node, std::string_view said, std::string_view expected);

}  // namespace nezumi::hw
