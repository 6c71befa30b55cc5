// The parameters of each kind of device on a wire.
#include <fmt/format.h>

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

ParameterSpec seconds(std::string name, double initial, double min, double max, std::string doc) {
    ParameterSpec spec = whole(std::move(name), 0, min, max, "s", std::move(doc));
    spec.initial = initial;
    return spec;
}

ParameterSpec numbers(std::string name, double min, double max, std::string doc) {
    ParameterSpec spec = whole(std::move(name), 0, min, max, "", std::move(doc));
    spec.initial = std::vector<std::int64_t>{};
    spec.max_size = 64;
    return spec;
}

template <class T>
const T& value_of(const Parameters& parameters, std::string_view name) {
    return parameters.find(name)->value.get<T>();
}

std::string check_i2c(const Parameters& parameters) {
    if (value_of<std::int64_t>(parameters, "address") == 0)
        return "address: expected the device's address on the bus, such as 0x40";
    const std::size_t registers = value_of<std::vector<std::int64_t>>(parameters, "registers").size();
    const std::size_t lengths = value_of<std::vector<std::int64_t>>(parameters, "lengths").size();
    if (registers == lengths) return "";
    return fmt::format("lengths: expected the bytes of each of the {} registers, got {} numbers", registers, lengths);
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
    static const std::array<DeviceKind, 3> kinds{
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
                              text("ends", "the end of each datagram's text: ports are TimedString then")})},
        DeviceKind{"i2c", "I2c",
                   with_safe({whole("bus", 1, 0, 255, "", "the bus's number: 1 is /dev/i2c-1"),
                              text("path", "instead of `bus`: the bus, such as /dev/i2c-1"),
                              whole("address", 0, 0, 0x77, "", "the device's address on the bus, 7 bits, such as 0x40"),
                              numbers("registers", 0, 255, "the registers that are read every period"),
                              numbers("lengths", 1, 32, "the bytes that are read from each of them"),
                              seconds("every", 0.05, 0.002, 60, "the period")}),
                   check_i2c}};
    return kinds;
}

const DeviceKind* find_device_kind(std::string_view type) {
    for (const DeviceKind& kind : device_kinds()) {
        if (kind.type == type) return &kind;
    }
    return nullptr;
}

}  // namespace nezumi
