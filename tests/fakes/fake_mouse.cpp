// A Raspberry Pi Mouse with a camera, without the robot: its drivers' nodes, and behind them the simulated world.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "tests/fakes/camera_nodes.hpp"
#include "tests/fakes/fake_robot.hpp"
#include "tests/fakes/joined_files.hpp"
#include "tests/fakes/mouse_nodes.hpp"

using namespace nezumi;

namespace {

void act(const RobotSpec& spec, RobotBody& body, fakes::MouseNodes& nodes) {
    const double metres = 2 * std::numbers::pi * spec.drive.radius / spec.drive.pulses_per_turn;
    const auto motion = nodes.motion();
    if (motion.power) {
        body.set_wheel_speeds({.left = motion.left * metres, .right = motion.right * metres});
    } else {
        body.coast();
    }
}

// Buttons that a rig presses in the world; those that a test presses at the nodes stay so.
void sense_buttons(const RobotSpec& spec, std::span<const SensorReading> readings, fakes::MouseNodes& nodes,
                   std::array<bool, 3>& pressed) {
    std::size_t button = 0;
    for (std::size_t i = 0; i < spec.sensors.size() && button < pressed.size(); ++i) {
        if (spec.sensors[i].kind != SensorSpec::Kind::button) continue;
        const bool is_pressed = readings[i].value != 0;
        if (is_pressed != std::exchange(pressed[button], is_pressed)) nodes.press(button, is_pressed);
        ++button;
    }
}

void sense(const RobotSpec& spec, std::span<const SensorReading> readings, fakes::MouseNodes& nodes) {
    // As the driver has them, whatever the robot file says.
    constexpr std::array<std::string_view, 4> order{"right_front", "right_side", "left_side", "left_front"};
    std::array<int, 4> lights{};
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        const auto channel = std::find(order.begin(), order.end(), spec.sensors[i].name) - order.begin();
        if (channel < 4) lights[static_cast<std::size_t>(channel)] = static_cast<int>(readings[i].value);
    }
    nodes.set_lights(lights);
}

std::string answer(const std::string& line, fakes::MouseNodes& nodes, fakes::CameraNodes& camera) {
    std::istringstream words(line);
    std::string command, name, value;
    words >> command >> name >> value;
    if (name == fakes::CameraNodes::node) {
        if (command == "unplug") {
            camera.unplug();
        } else if (command == "plug") {
            camera.plug_in();
        } else {
            return command == "fault" && camera.set_fault(value) ? "" : "unknown command or fault";
        }
        return "";
    }
    if (command == "fault") return nodes.set_fault(name, value) ? "" : "no such node or fault";
    if (command == "heal") {
        for (const std::string& node : nodes.names()) nodes.set_fault(node, "none");
        camera.set_fault("none");
    } else if (command == "button") {
        nodes.press(std::stoul(name), value == "1");
    } else if (command == "reload") {
        nodes.reload();
    } else if (command == "signed") {
        nodes.open_signed();
    } else if (command == "counters") {
        nodes.set_counters(static_cast<std::uint16_t>(std::stoul(name)));
    } else if (command == "motion") {  // left right power tone still_since (0: moves) leds
        const auto motion = nodes.motion();
        std::string text = fmt::format("{} {} {} {} {:.6f} ", motion.left, motion.right, motion.power ? 1 : 0,
                                       motion.tone, motion.still_since.value_or(0));
        for (const bool led : motion.leds) text += led ? '1' : '0';
        return text;
    } else if (command == "log") {
        return fakes::listed(nodes.log());
    } else if (command == "clear") {
        nodes.clear_log();
    } else {
        return "unknown command";
    }
    return "";
}

}  // namespace

int main(int count, char** words) {
    fakes::MouseNodes nodes;
    std::array<bool, 3> pressed{};
    fakes::CameraNodes camera;
    fakes::JoinedFiles all(nodes, camera, fakes::CameraNodes::node);
    return fakes::be_fake_robot(
        count, words, all, [&](const RobotSpec& spec, RobotBody& body) { act(spec, body, nodes); },
        [&](const RobotSpec& spec, RobotBody& /*body*/, const WheelReading& /*wheels*/,
            std::span<const SensorReading> readings) {
            sense(spec, readings, nodes);
            sense_buttons(spec, readings, nodes, pressed);
        },
        [&](const std::string& line) { return answer(line, nodes, camera); }, &camera);
}
