// Device nodes that the kernel numbers as they are plugged in: /dev/video0, /dev/input/event7.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi::hw {

/// The nodes "NAME0", "NAME1", ... in a folder, by their numbers: the first is the one that was plugged in first. None
/// where the folder can't be read.
std::vector<std::string> numbered_nodes(const std::string& folder, std::string_view name);

/// "/dev/video0" in the folder that stands for /dev; another path as it is.
std::string under_dev(const std::string& dev, const std::string& device);

}  // namespace nezumi::hw
