// The parameters of each kind of device on a wire.
#include <array>

#include "engine/devices/wired_device.hpp"

namespace nezumi {
namespace {

ParameterSpec text(std::string name, std::string doc) {
    ParameterSpec spec;
    spec.name = std::move(name);
    spec.initial = std::string();
    spec.doc = std::move(doc);
    return spec;
}

ParameterSpec whole(std::string name, std::int64_t initial, double min, double max, std::string unit, std::string doc) {
    ParameterSpec spec;
    spec.name = std::move(name);
    spec.initial = initial;
    spec.min = min;
    spec.max = max;
    spec.unit = std::move(unit);
    spec.doc = std::move(doc);
    return spec;
}

ParameterSpec flag(std::string name, std::string doc) {
    ParameterSpec spec;
    spec.name = std::move(name);
    spec.initial = false;
    spec.doc = std::move(doc);
    return spec;
}

std::vector<ParameterSpec> with_safe(std::vector<ParameterSpec> specs) {
    specs.push_back(text("safe",
                         "the bytes that stop what the device moves: sent at every kind of stop, and when the "
                         "engine dies; at most 255"));
    specs.push_back(flag("measures_only",
                         "the device moves nothing, so it needs no `safe`; in a robot file: "
                         "`safe = false`"));
    return specs;
}

}  // namespace

std::span<const DeviceKind> device_kinds() {
    static const std::array<DeviceKind, 2> kinds{
        DeviceKind{"serial", "Serial",
                   with_safe({text("path", "the device, such as /dev/ttyACM0"),
                              text("vendor", "instead of `path`: the USB vendor's number, such as \"2341\""),
                              text("serial_number", "with `vendor`: the device's own serial number"),
                              whole("baud", 115200, 50, 4000000, "Bd", "bits a second"),
                              text("ends", "the end of each line, such as \"\\n\": ports are TimedString then"),
                              text("terminator", "instead of `ends`: the last bytes of each frame"),
                              whole("length", 0, 0, 1024, "", "instead of `ends`: bytes of each frame"),
                              flag("cobs", "instead of `ends`: frames are encoded by COBS and end with 0")})},
        DeviceKind{"udp", "Udp",
                   with_safe({text("host", "the device's address, such as \"192.168.4.1\""),
                              whole("port", 0, 0, 65535, "", "the device's port"),
                              whole("local_port", 0, 0, 65535, "", "the own port; 0: any"),
                              text("ends", "the end of each datagram's text: ports are TimedString then")})}};
    return kinds;
}

const DeviceKind* find_device_kind(std::string_view type) {
    for (const DeviceKind& kind : device_kinds()) {
        if (kind.type == type) return &kind;
    }
    return nullptr;
}

}  // namespace nezumi
