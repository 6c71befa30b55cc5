// The ports of a driver are connected to the robot's ports with the same names; LINE_in and LINE_out to the device
// LINE.
#include "engine/system/script_drivers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/robot/scripted_body.hpp"
#include "engine/system/system.hpp"

namespace nezumi {
namespace {

std::string driver_of(const RobotEntry& robot) { return robot.name + "_driver"; }
std::string model_of(const RobotEntry& robot) { return robot.name + "_model"; }
std::string device_of(const RobotEntry& robot, std::string_view device) {
    return fmt::format("{}_{}", robot.name, device);
}

// Connects a behaviour: its in-port NAME with the robot's out-port PREFIX_NAME, and the same for out-ports.
class Connector {
public:
    Connector(System& system, const RobotEntry& robot, const RobotSpec& spec, std::string behavior, bool is_model)
        : system_(system), robot_(robot), spec_(spec), behavior_(std::move(behavior)), is_model_(is_model) {}

    Expected<void> connect() {
        const Component& component = *system_.find(behavior_);
        for (const InPortBase* port : component.in_ports()) {
            if (auto ok = connect(*port); !ok) return ok;
        }
        for (const OutPortBase* port : component.out_ports()) {
            if (auto ok = connect(*port); !ok) return ok;
        }
        for (const DeviceSpec& device : spec_.hardware.devices) {
            if (component.find_port(device.name + "_in") == nullptr &&
                component.find_port(device.name + "_out") == nullptr)
                return refuse(fmt::format("the behaviour has no port for the device '{0}': expected {0}_in or {0}_out",
                                          device.name));
        }
        return {};
    }

private:
    Unexpected refuse(const std::string& why) const {
        return failure(fmt::format("{} of robot '{}': {}", is_model_ ? "device_model" : "script", robot_.name, why),
                       spec_.place);
    }

    // The port at the other end: "rover.driver_wheel_pulses", "rover_line.out"; "" if there is none.
    std::string other_end(const Port& port) {
        const Direction wanted = port.direction() == Direction::in ? Direction::out : Direction::in;
        const std::string_view prefix = is_model_ ? ScriptedBody::to_model : ScriptedBody::to_driver;
        const Component& robot = *system_.find(robot_.name);
        std::string found;
        const auto look = [&](const Port& each) {
            if (!each.name().starts_with(prefix)) return;
            const std::string_view name = std::string_view(each.name()).substr(prefix.size());
            if (name == port.name()) found = path(robot, each);
            known_.emplace_back(name);
        };
        if (wanted == Direction::in) {
            for (const InPortBase* each : robot.in_ports()) look(*each);
        } else {
            for (const OutPortBase* each : robot.out_ports()) look(*each);
        }
        if (!found.empty()) return found;
        // The driver's LINE_in reads the device's `out`. The device model acts for the device: its LINE_in reads
        // `wire_out`.
        const std::string_view in = is_model_ ? "wire_out" : "out", out = is_model_ ? "wire_in" : "in";
        for (const DeviceSpec& device : spec_.hardware.devices) {
            const bool reads = wanted == Direction::out;
            std::string name = device.name + (reads ? "_in" : "_out");
            if (name == port.name()) return fmt::format("{}.{}", device_of(robot_, device.name), reads ? in : out);
            known_.push_back(std::move(name));
        }
        return "";
    }

    Expected<void> connect(const Port& port) {
        known_.clear();
        const std::string other = other_end(port);
        const bool reads = port.direction() == Direction::in;
        if (other.empty()) {
            const std::vector<std::string_view> known(known_.begin(), known_.end());
            std::string hint = did_you_mean(port.name(), known);
            if (hint.empty()) hint = fmt::format("; there are {}", fmt::join(known, ", "));
            return refuse(fmt::format("'{}' is not an {} of the robot or its devices{}", port.name(),
                                      reads ? "input" : "output", hint));
        }
        const std::string own = fmt::format("{}.{}", behavior_, port.name());
        const auto made = reads ? system_.connect(other, own) : system_.connect(own, other);
        return made ? Expected<void>() : refuse(made.error().message);
    }

    System& system_;
    const RobotEntry& robot_;
    const RobotSpec& spec_;
    std::string behavior_;
    bool is_model_;
    std::vector<std::string> known_;
};

}  // namespace

Expected<void> add_script_drivers(SystemSpec& spec) {
    std::vector<Entry> entries;
    const std::vector<Entry> given = spec.entries;
    for (const Entry& entry : given) {
        entries.push_back(entry);
        auto* robot = std::get_if<RobotEntry>(&entries.back());
        const auto model = robot == nullptr ? spec.models.end() : spec.models.find(robot->described_by());
        if (model == spec.models.end() || !robot->twin_of.empty()) continue;
        const HardwareSpec& hardware = model->second.hardware;
        const bool is_real = robot->backend == scripted;
        if (hardware.script.empty() || (!is_real && (robot->is_real() || hardware.device_model.empty()))) continue;
        const RobotEntry its = *robot;
        robot->driver = driver_of(its);
        BehaviorEntry driver;
        driver.name = driver_of(its);
        driver.script = hardware.script;
        driver.path = hardware.script_file;
        driver.place = model->second.place;
        BehaviorEntry device_model = driver;
        device_model.name = model_of(its);
        device_model.script = hardware.device_model;
        device_model.path = hardware.device_model_file;
        std::vector<Entry> parts;
        for (const DeviceSpec& device : hardware.devices) {
            ComponentEntry part;
            part.name = device_of(its, device.name);
            part.type = device.type;
            part.config = device.config;
            part.on = its.name;
            part.backend = is_real ? wired_backend : simulated;
            part.place = device.place;
            parts.emplace_back(std::move(part));
        }
        parts.emplace_back(std::move(driver));
        if (!is_real) parts.emplace_back(std::move(device_model));
        for (Entry& part : parts) {
            const auto taken = std::find_if(given.begin(), given.end(),
                                            [&](const Entry& other) { return name_of(other) == name_of(part); });
            if (taken != given.end())
                return failure(
                    fmt::format("'{}' is the name of a part of the robot '{}': give this component another name",
                                name_of(part), its.name),
                    place_of(*taken));
            entries.push_back(std::move(part));
        }
    }
    spec.entries = std::move(entries);
    return {};
}

void leave_out_script_drivers(SystemSpec& spec) {
    std::vector<std::string> parts;
    for (RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        if (robot->driver.empty()) continue;
        robot->driver.clear();
        for (const DeviceSpec& device : spec.models.at(robot->described_by()).hardware.devices)
            parts.push_back(device_of(*robot, device.name));
        parts.push_back(driver_of(*robot));
        parts.push_back(model_of(*robot));
    }
    for (const std::string& part : parts) {
        const std::string ports = part + ".";
        std::erase_if(spec.entries, [&](const Entry& entry) { return name_of(entry) == part; });
        std::erase_if(spec.connections, [&](const ConnectionSpec& connection) {
            return connection.from.starts_with(ports) || connection.to.starts_with(ports);
        });
    }
}

Expected<void> connect_script_drivers(System& system, const SystemSpec& spec) {
    for (const RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        Component* driver = robot->driver.empty() ? nullptr : system.find(robot->driver);
        if (driver == nullptr) continue;
        const RobotSpec& model = spec.models.at(robot->described_by());
        if (auto ok = Connector(system, *robot, model, driver->name(), false).connect(); !ok) return ok;
        if (const Component* its = system.find(model_of(*robot)); its != nullptr) {
            if (auto ok = Connector(system, *robot, model, its->name(), true).connect(); !ok) return ok;
        }
        ScriptedBody& body = *dynamic_cast<Robot*>(system.find(robot->name))->scripted_body();
        body.need(*driver, [driver] { return driver->state() == LifeState::active; });
    }
    return {};
}

}  // namespace nezumi
