// The interface of the drivers for devices on a wire: each kind is opened, read and written in a different way.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "engine/components/parameter.hpp"
#include "hw/device/roots.hpp"
#include "hw/guard/lease.hpp"
#include "hw/wire/write_target.hpp"

namespace nezumi::hw {

/// A message from a device.
struct Arrived {
    double tm = 0;  ///< [s] by `clock_seconds`
    std::string bytes;
};

/// An open device. Its destructor closes it.
class OpenWire {
public:
    virtual ~OpenWire() = default;
    /// Appends the messages that have arrived. Returns the longest time [s] until the next call. If the device is lost,
    /// returns an `errno` as the error; 0: it was unplugged.
    virtual tl::expected<double, int> read(std::vector<Arrived>& arrived) = 0;
    /// `read` must be called when this file has data; -1: no file.
    virtual int watched_file() const { return -1; }
    /// The device as the writer's process needs it.
    virtual WriteTarget target() const = 0;
};

/// A result, or an error of one line that says what to do.
template <class T>
using OrWhy = tl::expected<T, std::string>;
using Opened = OrWhy<std::unique_ptr<OpenWire>>;

/// The driver of a device that is described by parameters. Any thread may call its functions.
class WireDriver {
public:
    virtual ~WireDriver() = default;
    /// Opens the device, after checking that it is of this kind.
    virtual Opened open() const = 0;
    /// Checks that the device exists and that this user may use it. Sends nothing, and changes nothing.
    virtual OrWhy<void> examine() const {
        const auto opened = open();
        return opened ? OrWhy<void>() : tl::unexpected(opened.error());
    }
    /// Takes the lease of the device, because only one program may write to it. Without the device,
    /// `Lease::of_nothing`.
    virtual Expected<Lease> lease() const { return Lease::of_nothing(); }
    /// Encodes a message for the device; an error if the message is not valid for this device.
    virtual OrWhy<std::string> encode(std::string_view message) const { return std::string(message); }
    /// Encodes the message `safe`.
    virtual std::string encode_safe(std::string_view safe) const { return std::string(safe); }
    /// True if the time [s] of each message from the device, by the system's clock, is added as its last word.
    virtual bool has_times() const { return false; }
    /// The bytes that end a torn message.
    virtual std::string end() const { return ""; }
    /// Explains an error of `OpenWire::read`: why the device is lost.
    virtual std::string why_lost(int error) const;
};

using DriverOrWhy = OrWhy<std::unique_ptr<WireDriver>>;
/// Makes the driver of a device; an error if the parameters contradict each other.
using MakeWireDriver = DriverOrWhy (*)(const Parameters& parameters, const DeviceRoots& roots);

/// A serial line in raw mode, 8N1, given by its path or by its USB device. DTR is not lowered when the line is closed,
/// because that would reset some microcontrollers.
DriverOrWhy serial_driver(const Parameters& parameters, const DeviceRoots& roots);
/// A UDP socket connected to the device: other senders are ignored.
DriverOrWhy udp_driver(const Parameters& parameters, const DeviceRoots& roots);
/// A device on an I2C bus: its registers are read every period.
DriverOrWhy i2c_driver(const Parameters& parameters, const DeviceRoots& roots);
/// A device on SPI: frames are sent to it every period, and its answers are read.
DriverOrWhy spi_driver(const Parameters& parameters, const DeviceRoots& roots);
/// Lines of a GPIO chip, and PWM channels. Input lines send a message at the start and with each edge.
DriverOrWhy gpio_driver(const Parameters& parameters, const DeviceRoots& roots);

/// Finds the device node of the USB device with this vendor (four hexadecimal digits) and serial number ("": any). An
/// error lists the devices that exist.
OrWhy<std::string> find_usb_serial(const DeviceRoots& roots, const std::string& vendor,
                                   const std::string& serial_number);

/// The value of a parameter, which this kind of device must have.
template <class T>
const T& value_of(const Parameters& parameters, std::string_view name) {
    return parameters.find(name)->value.get<T>();
}

}  // namespace nezumi::hw
