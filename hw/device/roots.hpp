// Where devices are: /dev and /sys, or folders that stand for them.
#pragma once

#include <string>

namespace nezumi::hw {

struct DeviceRoots {
    std::string dev = "/dev";
    std::string sys = "/sys";
};

}  // namespace nezumi::hw
