// What each kind of device on a wire does in its own way: how it is opened, read, and written to.
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
    /// Appends what has arrived. Returns the longest time [s] until the next call, or the `errno` of a device that is
    /// lost; 0: it was unplugged.
    virtual tl::expected<double, int> read(std::vector<Arrived>& arrived) = 0;
    /// A file whose data need a call of `read`; -1: none.
    virtual int watched_file() const { return -1; }
    /// For the process that writes.
    virtual WriteTarget target() const = 0;
};

/// The error is one line with what to do.
template <class T>
using OrWhy = tl::expected<T, std::string>;
using Opened = OrWhy<std::unique_ptr<OpenWire>>;

/// A device that is described by parameters. Any thread may call its functions.
class WireDriver {
public:
    virtual ~WireDriver() = default;
    /// Opens the device, after checking that it is of this kind.
    virtual Opened open() const = 0;
    /// Whether the device is there and may be used. Sends nothing, and changes nothing.
    virtual OrWhy<void> examine() const {
        const auto opened = open();
        return opened ? OrWhy<void>() : tl::unexpected(opened.error());
    }
    /// Only one program may write to a device. Of nothing if there is no such device.
    virtual Expected<Lease> lease() const { return Lease::of_nothing(); }
    /// The bytes of a message; an error if it is not a message for this device.
    virtual OrWhy<std::string> encode(std::string_view message) const { return std::string(message); }
    /// The bytes of `safe`.
    virtual std::string encode_safe(std::string_view safe) const { return std::string(safe); }
    /// Whether each message from the device gets its time [s] by the system's clock as its last word.
    virtual bool has_times() const { return false; }
    /// What ends a torn message.
    virtual std::string end() const { return ""; }
    /// Why a device with this error, as of `OpenWire::read`, is lost.
    virtual std::string why_lost(int error) const;
};

using DriverOrWhy = OrWhy<std::unique_ptr<WireDriver>>;
/// Makes the driver of a device; an error if its parameters do not go together.
using MakeWireDriver = DriverOrWhy (*)(const Parameters& parameters, const DeviceRoots& roots);

/// A serial line in raw mode, 8N1. Its path, or that of the USB device. Does not lower DTR when it is closed, as that
/// would reset some microcontrollers.
DriverOrWhy serial_driver(const Parameters& parameters, const DeviceRoots& roots);
/// A UDP socket connected to the device: other senders are ignored.
DriverOrWhy udp_driver(const Parameters& parameters, const DeviceRoots& roots);
/// A device on an I2C bus: its registers are read every period.
DriverOrWhy i2c_driver(const Parameters& parameters, const DeviceRoots& roots);
/// A device on SPI: it is sent frames every period, and what it answers is read.
DriverOrWhy spi_driver(const Parameters& parameters, const DeviceRoots& roots);
/// Lines of a GPIO chip, and PWM channels. Input lines send a message at the start and with each edge.
DriverOrWhy gpio_driver(const Parameters& parameters, const DeviceRoots& roots);

/// The device node of the USB device with this vendor (four hexadecimal digits) and serial number ("": any), or an
/// error with those that there are.
OrWhy<std::string> find_usb_serial(const DeviceRoots& roots, const std::string& vendor,
                                   const std::string& serial_number);

/// The value of a parameter that the kind has.
template <class T>
const T& value_of(const Parameters& parameters, std::string_view name) {
    return parameters.find(name)->value.get<T>();
}

}  // namespace nezumi::hw
