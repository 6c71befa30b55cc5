// A robot's ports as its description lists them, or the one message that says which can't be.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "engine/robot/robot.hpp"

namespace nezumi {
namespace {

// A sensor's value as an element of type T: the nearest that an integer holds, a colour's name.
template <class T>
T element(double value) {
    if constexpr (std::is_same_v<T, std::string>) {
        return std::string(to_text(static_cast<FloorColor>(value)));
    } else if constexpr (std::is_same_v<T, bool>) {
        return value != 0;
    } else if constexpr (std::is_integral_v<T>) {
        const double lowest = std::numeric_limits<T>::lowest();
        const double highest = std::numeric_limits<T>::max();
        return static_cast<T>(std::round(value < lowest ? lowest : value > highest ? highest : value));
    } else {
        return static_cast<T>(value);
    }
}

template <class T>
constexpr bool can_carry = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

// How sensors' values go into a message of type T; nullptr where they don't.
using WriteValues = void (*)(OutPortBase&, const std::vector<double>&, double rate, const Pose3D* turned);

template <class T>
constexpr WriteValues write_values() {
    if constexpr (can_carry<T>) {
        return [](OutPortBase& port, const std::vector<double>& values, double, const Pose3D*) {
            static_cast<OutPort<T>&>(port).write(element<T>(values.front()));
        };
    } else if constexpr (Sequence<T>) {
        using Element = typename T::value_type;
        if constexpr (can_carry<Element>) {
            return [](OutPortBase& port, const std::vector<double>& values, double, const Pose3D*) {
                T& slot = static_cast<OutPort<T>&>(port).next_pending();
                slot.resize(values.size());
                for (std::size_t i = 0; i < values.size(); ++i) slot[i] = element<Element>(values[i]);
            };
        } else {
            return nullptr;
        }
    } else if constexpr (std::is_same_v<T, RangeData>) {
        return [](OutPortBase& port, const std::vector<double>& values, double rate, const Pose3D* turned) {
            RangeData& slot = static_cast<OutPort<RangeData>&>(port).next_pending();
            slot.ranges = values;
            slot.config.frequency = rate;
            if (turned != nullptr) slot.geometry.pose = *turned;
        };
    } else {
        return nullptr;
    }
}

// Whether a message of type T carries colours' names, and no numbers.
template <class T>
constexpr bool is_text = std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<std::string>>;

}  // namespace

Expected<void> Robot::add_port(const PortSpec& port) {
    if (find_port(port.name) != nullptr) return failure("is declared twice");
    if (port.items.empty()) return failure("says nothing of what it carries");
    return port.is_input ? add_input(port) : add_output(port);
}

Expected<void> Robot::add_output(const PortSpec& port) {
    const auto type = find_message_type(port.type);
    if (!type) return Unexpected(type.error());
    const std::string& item = port.items.front();
    if (item == "velocity" || item == "odometry") {
        const std::string_view expected = item == "velocity" ? "TimedVelocity2D" : "TimedPose2D";
        if (port.type != expected) return failure(fmt::format("'{}' is a {}, not a {}", item, expected, port.type));
        if (item == "velocity") {
            auto& made = add_out_port<Velocity2D>(port.name, port.doc);
            made.set_safe(std::nullopt);  // a measurement, no command
            velocity_ports_.push_back({&made, port.rate});
        } else {
            pose_ports_.push_back({&add_out_port<Pose2D>(port.name, port.doc), port.rate});
        }
        return {};
    }
    std::vector<std::size_t> sensors;
    for (const std::string& name : port.items) {
        std::vector<std::string_view> names{"velocity", "odometry"};
        std::size_t found = spec_.sensors.size();
        for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
            if (spec_.sensors[i].name == name) found = i;
            names.push_back(spec_.sensors[i].name);
        }
        if (found == spec_.sensors.size())
            return failure(fmt::format("there is no sensor '{}'{}", name, did_you_mean(name, names)));
        sensors.push_back(found);
    }
    return with_payload_type(*type, [&]<class T>() -> Expected<void> {
        constexpr WriteValues write = write_values<T>();
        if (write == nullptr) return failure(fmt::format("a {} can't carry sensors' values", port.type));
        if (can_carry<T> && sensors.size() > 1)
            return failure(fmt::format("a {} carries one sensor, not {}", port.type, sensors.size()));
        for (const std::size_t i : sensors) {
            const SensorSpec& sensor = spec_.sensors[i];
            if (is_text<T> && sensor.kind != SensorSpec::Kind::color)
                return failure(
                    fmt::format("a {} carries colours, and '{}' is no color sensor", port.type, sensor.name));
        }
        OutPort<T>& made = add_out_port<T>(port.name, port.doc);
        bool distance = port.quantity == PortSpec::Quantity::distance;
        std::optional<std::size_t> servo;
        if constexpr (std::is_same_v<T, RangeData>) {
            distance = true;
            const SensorSpec& first = spec_.sensors[sensors.front()];
            RangeData range;
            range.geometry.pose = {.position = first.at, .orientation = {.r = 0, .p = 0, .y = first.yaw}};
            range.config = {.minAngle = 0,
                            .maxAngle = 0,
                            .angularRes = first.cone,
                            .minRange = first.minimum,
                            .maxRange = first.range,
                            .rangeRes = 0,
                            .frequency = 0};
            made.prepare(range);
            for (std::size_t i = 0; i < spec_.actuators.size(); ++i) {
                const ActuatorSpec& actuator = spec_.actuators[i];
                if (actuator.kind == ActuatorSpec::Kind::servo && actuator.name == first.on) servo = i;
            }
        }
        sensor_ports_.push_back({&made, write, sensors, distance, port.rate, servo});
        return {};
    });
}

Expected<void> Robot::add_input(const PortSpec& port) {
    if (port.items.size() != 1) return failure("goes to one thing only");
    const std::string& item = port.items.front();
    const auto is_type = [&](std::string_view type) -> Expected<void> {
        if (port.type == type) return {};
        return failure(fmt::format("'{}' takes a {}, not a {}", item, type, port.type));
    };
    if (item == "drive") {
        if (auto ok = is_type("TimedVelocity2D"); !ok) return ok;
        if (velocity_in_ != nullptr) return failure("a robot has one in-port for its drive");
        velocity_in_ = &add_in_port<Velocity2D>(port.name, port.doc, port.queue);
        return {};
    }
    if (item == "odometry") {
        if (auto ok = is_type("TimedPose2D"); !ok) return ok;
        if (pose_in_ != nullptr) return failure("a robot has one in-port for its odometry");
        pose_in_ = &add_in_port<Pose2D>(port.name, port.doc, port.queue);
        return {};
    }
    std::vector<std::string_view> names{"drive", "odometry"};
    for (std::size_t i = 0; i < spec_.actuators.size(); ++i) {
        const ActuatorSpec& actuator = spec_.actuators[i];
        names.push_back(actuator.name);
        if (actuator.name != item) continue;
        const std::string_view type = Actuators::type_for(actuator.kind);
        if (auto ok = is_type(type); !ok) return ok;
        in_ports_.push_back(make_in_port(*find_message_type(type), port.name, port.doc, port.queue));
        return actuators_.add(i, *in_ports_.back(), port.off_when_silent);
    }
    return failure(fmt::format("there is no actuator '{}'{}", item, did_you_mean(item, names)));
}

}  // namespace nezumi
