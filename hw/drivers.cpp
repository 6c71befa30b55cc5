// The table of drivers.
#include "hw/drivers.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "engine/devices/camera.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/devices/wired_device.hpp"
#include "hw/camera/video_camera.hpp"
#include "hw/ev3/ev3_body.hpp"
#include "hw/gamepad/evdev_gamepad.hpp"
#include "hw/raspimouse/mouse_body.hpp"
#include "hw/wire/wire_link.hpp"

namespace nezumi::hw {
namespace {

ComponentMaker gamepads(const std::string& dev) {
    return [dev](const ComponentEntry& entry, System& /*system*/) {
        return std::make_unique<Joystick>(
            entry.name, [dev](const GamepadSettings& settings) { return open_gamepad(dev, settings); });
    };
}

ComponentMaker cameras(const std::string& dev) {
    return [dev](const ComponentEntry& entry, System& system) {
        return make_camera(entry, system, [dev](const CameraMount& /*mount*/, const CameraSettings& settings) {
            return open_camera(dev, settings);
        });
    };
}

// The drivers of devices on a wire, by the component's type (engine/devices/device_kinds.cpp).
constexpr std::pair<std::string_view, MakeWireDriver> wire_drivers[] = {
    {"Serial", serial_driver}, {"Udp", udp_driver}, {"I2c", i2c_driver}, {"Spi", spi_driver}, {"Gpio", gpio_driver}};

}  // namespace

ByBackend<BodyMaker> drivers(const DeviceRoots& roots) {
    return {
        {"raspimouse",
         [roots](const RobotEntry& /*entry*/, const RobotSpec& spec) { return MouseBody::make(spec, roots); }},
        {"ev3", [roots](const RobotEntry& /*entry*/, const RobotSpec& spec) { return Ev3Body::make(spec, roots); }}};
}

decltype(Makers::components) device_drivers(const DeviceRoots& roots) {
    decltype(Makers::components) all{{"Joystick", {{"gamepad", gamepads(roots.dev)}}},
                                     {"Camera", {{"video", cameras(roots.dev)}}}};
    for (const auto& [type, make] : wire_drivers) {
        all[std::string(type)][std::string(wired_backend)] = [roots, make = make](const ComponentEntry& entry,
                                                                                  System& system) {
            return make_wired_device(entry, system,
                                     [&](const Parameters& parameters) { return open_wire(make, parameters, roots); });
        };
    }
    return all;
}

Expected<void> examine_device(const ComponentEntry& entry, const DeviceRoots& roots) {
    const auto parameters = device_parameters(entry);
    if (!parameters) return Unexpected(parameters.error());
    const auto* found = std::find_if(std::begin(wire_drivers), std::end(wire_drivers),
                                     [&](const auto& each) { return each.first == entry.type; });
    const auto driver = found->second(*parameters, roots);
    if (!driver) return failure(driver.error());
    if (const auto lease = (*driver)->lease(); !lease) return Unexpected(lease.error());
    const auto works = (*driver)->examine();
    return works ? Expected<void>() : failure(works.error());
}

}  // namespace nezumi::hw
