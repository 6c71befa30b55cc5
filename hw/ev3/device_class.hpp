// A device of the brick by what it is and where it is plugged in: its number says nothing.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// One of ev3dev's folders of devices, "/sys/class/tacho-motor" or "/sys/class/lego-sensor": each device is a folder in
/// it, whose number grows with every plugging in.
class DeviceClass {
public:
    explicit DeviceClass(DevicePath folder) : folder_(std::move(folder)) {}

    /// The folder of the device with this driver ("lego-ev3-gyro") at this port ("in2"; "": at any). An error says what
    /// is there instead, and what to do.
    tl::expected<DevicePath, std::string> find(std::string_view driver, std::string_view port) const;
    const DevicePath& folder() const { return folder_; }

private:
    DevicePath folder_;
};

/// Why a node of the brick does not work, with what to do.
std::string with_ev3_advice(const NodeError& error);

/// Reads a node that holds a whole number; an error with what to do.
tl::expected<long long, std::string> read_whole_number(Node& node);

}  // namespace nezumi::hw
