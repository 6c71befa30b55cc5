// A LEGO EV3 without the brick: ev3dev's nodes in sys/ and dev/, and behind them the simulated world.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/fakes/ev3_nodes.hpp"
#include "tests/fakes/fake_robot.hpp"

using namespace nezumi;

namespace {

constexpr double degree = std::numbers::pi / 180;  // a pulse of all motors

std::size_t arm_of(const RobotSpec& spec) {
    for (std::size_t i = 0; i < spec.actuators.size(); ++i) {
        if (spec.actuators[i].kind == ActuatorSpec::Kind::servo) return i;
    }
    return spec.actuators.size();
}

void act(const RobotSpec& spec, RobotBody& body, fakes::Ev3Nodes& nodes) {
    const double metres = degree * spec.drive.radius;
    const auto motion = nodes.motion();
    // The world's body has one way to roll: with both wheels.
    if (motion.left_rolls && motion.right_rolls) {
        body.coast();
    } else {
        body.set_wheel_speeds({.left = motion.left * metres, .right = motion.right * metres});
    }
    const std::size_t arm = arm_of(spec);
    if (arm < spec.actuators.size()) {
        const double angle = motion.arm ? static_cast<double>(motion.arm->first) * degree : body.servo_angle(arm);
        body.aim_servo(arm, angle, motion.arm ? motion.arm->second * degree : 0);
    }
}

void sense(const RobotSpec& spec, RobotBody& body, const WheelReading& wheels, std::span<const SensorReading> readings,
           fakes::Ev3Nodes& nodes) {
    const std::size_t arm = arm_of(spec);
    const double angle = arm < spec.actuators.size() ? body.servo_angle(arm) : 0;
    nodes.set_turned(wheels.pulses.left, wheels.pulses.right, std::lround(angle / degree));
    double distance = 2.5, turned = 0, rate = 0;
    bool right = false, left = false;
    for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
        const SensorSpec& sensor = spec.sensors[i];
        if (sensor.kind == SensorSpec::Kind::range) distance = readings[i].physical;
        if (sensor.kind == SensorSpec::Kind::gyro) {
            turned = readings[i].value;
            rate = readings[i].physical;
        }
        if (sensor.name == "right") right = readings[i].value != 0;
        if (sensor.name == "left") left = readings[i].value != 0;
    }
    nodes.set_around(distance, turned, rate, right, left);
}

std::string answer(const std::string& line, fakes::Ev3Nodes& nodes) {
    std::istringstream words(line);
    std::string command, name, value;
    words >> command >> name >> value;
    if (command == "fault") return nodes.set_fault(name, value) ? "" : "no such node or fault";
    if (command == "unplug") return nodes.unplug(name) ? "" : "nothing there";
    if (command == "plug") return nodes.plug_in(name) ? "" : "not unplugged";
    if (command == "key") return nodes.press(name, value == "1") ? "" : "no such key";
    if (command == "mode") return nodes.set_mode(name, value) ? "" : "no such mode";
    if (command == "heal") {
        nodes.heal();
    } else if (command == "battery") {
        nodes.set_battery(std::stoi(name));
    } else if (command == "floor") {  // three numbers
        std::array<int, 3> raw{};
        std::istringstream numbers(line.substr(command.size()));
        numbers >> raw[0] >> raw[1] >> raw[2];
        nodes.set_floor(raw);
    } else if (command == "motion") {  // left right rolls still_since (0: moves) leds
        const auto motion = nodes.motion();
        return fmt::format("{} {} {} {:.6f} {}", motion.left, motion.right,
                           motion.left_rolls && motion.right_rolls ? 1 : 0, motion.still_since, nodes.leds());
    } else if (command == "frame") {  // hexadecimal
        std::string text;
        for (const char byte : nodes.frame()) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
        return text;
    } else if (command == "log") {
        return fakes::listed(nodes.log());
    } else {
        return "unknown command";
    }
    return "";
}

}  // namespace

int main(int count, char** words) {
    fakes::Ev3Nodes nodes;
    return fakes::be_fake_robot(
        count, words, nodes, [&](const RobotSpec& spec, RobotBody& body) { act(spec, body, nodes); },
        [&](const RobotSpec& spec, RobotBody& body, const WheelReading& wheels,
            std::span<const SensorReading> readings) { sense(spec, body, wheels, readings, nodes); },
        [&](const std::string& line) { return answer(line, nodes); });
}
