// The folders of devices: /dev and /sys, or other folders that replace them.
#pragma once

#include <memory>
#include <string>

#include "hw/device/files.hpp"

namespace nezumi::hw {

struct DeviceRoots {
    std::string dev = "/dev";
    std::string sys = "/sys";
    std::shared_ptr<DeviceFiles> files = kernel_files();  ///< the access for drivers

    DevicePath in_dev() const { return {dev, files}; }
    DevicePath in_sys() const { return {sys, files}; }
};

}  // namespace nezumi::hw
