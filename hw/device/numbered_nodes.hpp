// Device nodes numbered by the kernel: /dev/video0, /dev/input/event7.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi::hw {

/// The nodes "NAME0", "NAME1", ... in a folder, sorted by number, which is the order of plugging in. Empty if the
/// folder can't be read.
std::vector<std::string> numbered_nodes(const std::string& folder, std::string_view name);

/// Replaces /dev at the beginning of a path such as "/dev/video0" by the folder `dev`; other paths are unchanged.
std::string under_dev(const std::string& dev, const std::string& device);

}  // namespace nezumi::hw
