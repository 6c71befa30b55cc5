// Opens a device on a wire, after checking that it is one.
#pragma once

#include <memory>
#include <string>
#include <tl/expected.hpp>

#include "engine/components/parameter.hpp"
#include "hw/device/roots.hpp"

namespace nezumi::hw {

/// An open device; closes it.
struct OpenWire {
    int file = -1;
    bool is_plain = false;     ///< a plain file in place of a device: nothing is read, the last message is its content
    bool is_datagram = false;  ///< reads and writes whole messages

    OpenWire(int opened, bool plain, bool datagram) : file(opened), is_plain(plain), is_datagram(datagram) {}
    ~OpenWire();
    OpenWire(const OpenWire&) = delete;
    OpenWire& operator=(const OpenWire&) = delete;
};

/// Opens the device of these parameters. The error is one line with what to do.
using Opened = tl::expected<std::unique_ptr<OpenWire>, std::string>;

/// A serial line in raw mode, 8N1. Its path, or that of the USB device. Does not lower DTR when it is closed, as that
/// would reset some microcontrollers.
Opened open_serial(const Parameters& parameters, const DeviceRoots& roots);
/// A UDP socket connected to the device: other senders are ignored.
Opened open_udp(const Parameters& parameters, const DeviceRoots& roots);

/// What the lease of a device is called: only one program may write to it. "" if the device can't have one.
std::string lease_of(const std::string& type, const Parameters& parameters, const DeviceRoots& roots);

/// The device node of the USB device with this vendor (four hexadecimal digits) and serial number ("": any), or an
/// error with those that there are.
tl::expected<std::string, std::string> find_usb_serial(const DeviceRoots& roots, const std::string& vendor,
                                                       const std::string& serial_number);

}  // namespace nezumi::hw
