// Checks the address and the driver of each device in a class folder.
#include "hw/ev3/device_class.hpp"

#include <fmt/format.h>

#include <cerrno>

#include "engine/base/error.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi::hw {
namespace {

std::string_view without_newline(std::string_view text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
    return text;
}

// The first line of a file; "" if it can't be read because the device was removed.
std::string read_line(const DevicePath& path) {
    Node node(path, Node::Access::read);
    const auto text = node.read();
    return text ? std::string(without_newline(*text)) : "";
}

}  // namespace

std::string_view port_of(std::string_view address) {
    const std::size_t colon = address.rfind(':');
    return colon == std::string_view::npos ? address : address.substr(colon + 1);
}

tl::expected<DevicePath, std::string> DeviceClass::find(std::string_view driver, std::string_view port) const {
    const auto devices = folder_.files().list(folder_.text());
    if (!devices)
        return tl::unexpected(describe(NodeError{folder_.text(), devices.error()}) +
                              ": is this an EV3 brick with ev3dev?");
    std::string other;
    for (const std::string& device : *devices) {
        const DevicePath folder = folder_ + "/" + device;
        const std::string there = read_line(folder + "/driver_name"), address = read_line(folder + "/address");
        const bool is_port = port.empty() || port_of(address) == port;
        if (is_port && there == driver) return folder;
        if (is_port && !port.empty()) other = there;
    }
    if (port.empty()) return tl::unexpected(fmt::format("no {} is plugged in: look at its cable", driver));
    if (other.empty())
        return tl::unexpected(
            fmt::format("nothing is plugged in at {}, expected a {}: look at its cable", port, driver));
    return tl::unexpected(
        fmt::format("a {} is plugged in at {}, expected a {}: change their cables, or set port = ... "
                    "in the robot file",
                    shown(other), port, driver));
}

std::string with_ev3_advice(const NodeError& error) {
    switch (error.code) {
        case ENOENT:
        case ENODEV:
        case ENXIO: return describe(error) + ": it is unplugged: look at its cable";
        case EACCES:
        case EPERM: return describe(error) + ": this user has no permission to use it. Try: sudo adduser $USER ev3dev";
        case EISDIR: return describe(error) + " and no file of ev3dev's: is --sys-root right?";
        default: return describe(error) + ": look at its cable, and at what dmesg says";
    }
}

tl::expected<long long, std::string> read_whole_number(Node& node) {
    const auto text = node.read();
    if (!text) return tl::unexpected(with_ev3_advice(text.error()));
    const std::string_view digits = without_newline(*text);
    if (const auto value = number_in<long long>(digits)) return *value;
    return tl::unexpected(
        fmt::format("{}: expected a number, got '{}': is it the node of another driver?", node.path(), shown(digits)));
}

}  // namespace nezumi::hw
