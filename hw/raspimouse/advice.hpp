// What a person can do about a node of the mouse that does not work.
#pragma once

#include <string>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// "/dev/rtled0: no such file or directory: is the driver loaded? Try: sudo modprobe rtmouse".
std::string with_advice(const NodeError& error);

/// Of a node that said something else than its driver would.
std::string not_understood(const Node& node, std::string_view said, std::string_view expected);

}  // namespace nezumi::hw
