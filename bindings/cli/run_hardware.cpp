// From simulated robots to real ones, before the system is built.
#include "bindings/cli/run_hardware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>
#include <variant>

#include "bindings/lua/files/calibration_file.hpp"
#include "engine/base/program.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/system/build_system.hpp"
#include "hw/drivers.hpp"

namespace nezumi::cli {
namespace {

using Drivers = decltype(Makers::components);

// What `--hw` may make real: robots, and components that there is a driver for.
bool may_be_real(const Entry& entry, const Drivers& drivers) {
    const auto* component = std::get_if<ComponentEntry>(&entry);
    return std::holds_alternative<RobotEntry>(entry) || (component != nullptr && drivers.contains(component->type));
}

Expected<void> check_names(const SystemSpec& spec, const std::vector<std::string>& names, const Drivers& drivers) {
    std::vector<std::string_view> known;
    for (const Entry& entry : spec.entries) {
        if (may_be_real(entry, drivers)) known.push_back(name_of(entry));
    }
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        return failure(fmt::format("--hw: there is no robot or device '{}' in {}{}", shown(name), spec.file,
                                   did_you_mean(name, known)));
    }
    return {};
}

bool is_among(const std::string& name, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Whether the file lets it be real; an error where it was asked for by its name.
template <class AnEntry>
Expected<bool> is_free(std::string_view kind, const AnEntry& entry, const std::vector<std::string>& names) {
    const bool is_named = is_among(entry.name, names);
    if (!names.empty() && !is_named) return false;
    if (entry.backend != simulated) return true;
    if (!is_named) return false;
    return failure(fmt::format("{} '{}': --hw={} wants the real one, and backend = \"sim\" keeps it simulated", kind,
                               entry.name, entry.name),
                   entry.place);
}

// Whether it became a real one.
Expected<bool> choose(RobotEntry& robot, const SystemSpec& spec, const std::vector<std::string>& names) {
    auto free = is_free("robot", robot, names);
    if (free && !*free && robot.backend != simulated) robot.backend.clear();  // it names a driver, and is not asked for
    if (!free || !*free || !robot.backend.empty()) return free;
    const auto model = spec.models.find(robot.described_by());
    robot.backend = model == spec.models.end() ? "" : model->second.hardware.driver;
    if (!robot.backend.empty()) return true;
    return failure(fmt::format("robot '{}': its model '{}' names no driver: add hardware = {{ driver = ... }} to the "
                               "model, or keep the robot simulated by backend = \"sim\"",
                               robot.name, robot.model),
                   robot.place);
}

// What a robot carries is as real as the robot.
bool is_on_simulated(const ComponentEntry& component, const SystemSpec& spec) {
    return std::any_of(spec.entries.begin(), spec.entries.end(), [&](const Entry& entry) {
        const auto* robot = std::get_if<RobotEntry>(&entry);
        return robot != nullptr && robot->name == component.on &&
               (robot->backend.empty() || robot->backend == simulated);
    });
}

Expected<bool> choose(ComponentEntry& component, const SystemSpec& spec, const std::vector<std::string>& names,
                      const Drivers& drivers) {
    const auto type = drivers.find(component.type);
    if (type == drivers.end() || is_on_simulated(component, spec)) return false;
    // With its robot it is meant as well.
    auto free = is_free("component", component, is_among(component.on, names) ? std::vector<std::string>{} : names);
    if (free && *free && component.backend.empty()) component.backend = type->second.begin()->first;
    return free;
}

// Whether this button of a real robot is pressed; "" is no button.
bool is_pressed(const Robot& robot, const std::string& button) {
    const RobotSpec& spec = robot.spec();
    for (std::size_t i = 0; robot.is_real() && i < spec.sensors.size() && i < robot.readings().size(); ++i) {
        const SensorReading& reading = robot.readings()[i];
        if (!button.empty() && spec.sensors[i].name == button) return reading.is_there && reading.value != 0;
    }
    return false;
}

}  // namespace

Expected<void> choose_drivers(SystemSpec& spec, const std::vector<std::string>& names,
                              const decltype(Makers::components)& drivers) {
    if (auto ok = check_names(spec, names, drivers); !ok) return ok;
    bool any = false;
    // Robots first, wherever the file has them: what they carry goes with them.
    for (Entry& entry : spec.entries) {
        auto* robot = std::get_if<RobotEntry>(&entry);
        if (robot == nullptr) continue;
        const auto real = choose(*robot, spec, names);
        if (!real) return Unexpected(real.error());
        any = any || *real;
    }
    for (Entry& entry : spec.entries) {
        auto* component = std::get_if<ComponentEntry>(&entry);
        if (component == nullptr) continue;
        const auto real = choose(*component, spec, names, drivers);
        if (!real) return Unexpected(real.error());
        any = any || *real;
    }
    if (!any) return failure(fmt::format("--hw: {} has no robot that could be real", spec.file));
    if (spec.rate < slowest_hardware_rate)
        return failure(fmt::format("--hw: {} ticks a second are too few to drive a real robot: expected {} or more",
                                   spec.rate, slowest_hardware_rate),
                       spec.rate_place);
    return {};
}

std::string serial_number(const std::string& sys_root) {
    std::ifstream file(sys_root + "/firmware/devicetree/base/serial-number");
    std::string serial;
    std::getline(file, serial, '\0');
    return serial;
}

Expected<void> use_calibrations(SystemSpec& spec, const LiveOptions& live, const std::optional<std::string>& serial) {
    const Project project = Project::of(spec.file, live.installed, *live.files);
    for (Entry& entry : spec.entries) {
        auto* robot = std::get_if<RobotEntry>(&entry);
        if (robot == nullptr || robot->backend.empty() || robot->backend == simulated) continue;
        if (auto used = use_calibration(spec, *robot, project, {.is_needed = false, .serial = serial}); !used)
            return used;
    }
    return {};
}

Expected<void> add_twins(SystemSpec& spec) {
    std::vector<Entry> entries;
    for (Entry& entry : spec.entries) {
        const auto* real = std::get_if<RobotEntry>(&entry);
        if (real == nullptr || real->backend.empty() || real->backend == simulated) {
            entries.push_back(std::move(entry));
            continue;
        }
        RobotEntry twin = *real;
        twin.name = real->name + "_twin";
        const auto taken = std::find_if(spec.entries.begin(), spec.entries.end(),
                                        [&](const Entry& other) { return name_of(other) == twin.name; });
        if (taken != spec.entries.end())
            return failure(fmt::format("--twin: the twin of '{}' is called '{}': give this one another name",
                                       real->name, twin.name),
                           place_of(*taken));
        RobotSpec description = spec.models.at(real->described_by());
        std::erase_if(description.ports, [](const PortSpec& port) { return port.is_input; });
        for (ActuatorSpec& actuator : description.actuators) actuator.speed = 0;  // no parameter for it
        description.drive.needs.clear();
        description.hardware = {};
        spec.models.insert_or_assign(twin.name, std::move(description));
        twin.description = twin.name;
        twin.backend = simulated;
        twin.twin_of = real->name;
        entries.push_back(std::move(entry));
        entries.emplace_back(std::move(twin));
    }
    if (entries.size() == spec.entries.size())
        return failure(fmt::format("--twin: {} has no real robot to simulate beside", spec.file));
    spec.entries = std::move(entries);
    return {};
}

void use_hardware(LiveOptions& live, const Hardware& hardware, const hw::DeviceRoots& roots) {
    live.bodies = hw::drivers(roots);
    auto drivers = hw::device_drivers(roots);
    for (const auto& [type, by_backend] : drivers) live.components[type].insert(by_backend.begin(), by_backend.end());
    live.prepare = [hardware, drivers = std::move(drivers),
                    serial = roots.files->are_real() ? std::optional(serial_number(hardware.sys_root)) : std::nullopt,
                    files = LiveOptions{.installed = live.installed, .files = live.files}](SystemSpec& spec) {
        auto ready = choose_drivers(spec, hardware.robots, drivers);
        if (ready) ready = use_calibrations(spec, files, serial);
        return ready && hardware.twins ? add_twins(spec) : ready;
    };
    live.build.real_time = true;
    live.build.out_of_time_is_fatal = false;
    live.budget = paced_budget;
}

ShutdownButtons::ShutdownButtons(RunLoop& loop, std::function<void(std::string)> say)
    : loop_(loop), say_(std::move(say)) {
    if (loop.is_hardware()) loop.after_tick([this] { after_tick(); });
}

void ShutdownButtons::after_tick() {
    const System& system = loop_.live().system();
    for (const Robot* robot : system.robots()) {
        if (!is_pressed(*robot, robot->spec().hardware.shutdown)) {
            pressed_at_.erase(robot->name());
            continue;
        }
        const double since = pressed_at_.try_emplace(robot->name(), system.now().seconds).first->second;
        if (system.now().seconds - since < long_press || std::exchange(is_wanted_, true)) continue;
        say_(fmt::format("{}: {} was held for {} s: the run ends, and the computer is shut down", robot->name(),
                         robot->spec().hardware.shutdown, long_press));
        loop_.quit();
    }
}

void ShutdownButtons::finish() const {
    if (!is_wanted_) return;
    if (const std::string problem = problem_of(run_program({.words = {"systemctl", "poweroff"}})); !problem.empty())
        say_(fmt::format("the computer can't be shut down: systemctl poweroff: {}. Try: sudo systemctl poweroff",
                         problem));
}

StopButtons::StopButtons(RunLoop& loop) : loop_(loop) {
    if (loop.is_hardware()) loop.after_tick([this] { after_tick(); });
}

void StopButtons::after_tick() {
    for (const Component* component : loop_.live().system().components()) {
        const auto* joystick = dynamic_cast<const Joystick*>(component);
        if (joystick == nullptr) continue;
        const int stops = joystick->stops();
        // An emergency stop is never refused.
        if (std::exchange(seen_[joystick->name()], stops) < stops)
            static_cast<void>(loop_.live().act(Stop{}, {Actor::Kind::joystick, joystick->name()}));
    }
}

StartButtons::StartButtons(RunLoop& loop, std::function<void(std::string)> say) : loop_(loop), say_(std::move(say)) {
    for (const Robot* robot : loop.live().system().robots()) {
        const std::string& button = robot->spec().hardware.start;
        if (!robot->is_real() || button.empty()) continue;
        waiting_.push_back(robot->name());
        say_(fmt::format("{} WAITS: PRESS {} ON THE ROBOT, and it starts to move", robot->name(), button));
    }
    if (waiting_.empty()) return;
    loop_.pause();
    loop_.after_tick([this] { after_tick(); });
}

void StartButtons::after_tick() {
    if (waiting_.empty()) return;
    if (!loop_.is_paused()) {
        waiting_.clear();  // somebody at the console knows what they do
        return;
    }
    std::erase_if(waiting_, [this](const std::string& name) {
        const Robot* robot = loop_.live().system().find_robot(name);
        if (robot == nullptr) return true;
        if (!is_pressed(*robot, robot->spec().hardware.start)) return false;
        say_(name + " starts");
        return true;
    });
    if (waiting_.empty()) loop_.resume();
}

}  // namespace nezumi::cli
