// Finds a device of the brick by driver and port, because the number in its path is not fixed.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hw/device/node.hpp"

namespace nezumi::hw {

/// A folder of ev3dev devices, "/sys/class/tacho-motor" or "/sys/class/lego-sensor". Each device is a folder in it with
/// a number, which increases each time a device is plugged in.
class DeviceClass {
public:
    explicit DeviceClass(DevicePath folder) : folder_(std::move(folder)) {}

    /// Returns the folder of the device with this driver ("lego-ev3-gyro") at this port ("in2"; "": any). An error says
    /// which device is plugged in instead, and what to do.
    tl::expected<DevicePath, std::string> find(std::string_view driver, std::string_view port) const;
    const DevicePath& folder() const { return folder_; }

private:
    DevicePath folder_;
};

/// The port in an address: "outB" for "ev3-ports:outB", and for "outB" on older systems.
std::string_view port_of(std::string_view address);

/// Describes why a device file of the brick does not work, with what to do.
std::string with_ev3_advice(const NodeError& error);

/// Reads an integer from a node. An error says what to do.
tl::expected<long long, std::string> read_whole_number(Node& node);

}  // namespace nezumi::hw
