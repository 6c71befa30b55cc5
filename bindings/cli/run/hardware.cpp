// Replaces simulated robots by real ones before the system is built.
#include "bindings/cli/run/hardware.hpp"

#include <fmt/format.h>

#include <fstream>
#include <utility>
#include <variant>

#include "bindings/lua/files/calibration_file.hpp"
#include "engine/base/list.hpp"
#include "engine/live/twins.hpp"
#include "engine/system/build_system.hpp"
#include "hw/drivers.hpp"

namespace nezumi::cli {
namespace {

using Drivers = decltype(Makers::components);

// What `--hw` can make real: robots, and components with a driver.
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
        if (contains(known, name)) continue;
        return failure(fmt::format("--hw: there is no robot or device '{}' in {}{}", shown(name), spec.file,
                                   did_you_mean(name, known)));
    }
    return {};
}

// Returns true if this robot or device should be real. Returns an error if --hw names it, but the file keeps it
// simulated.
template <class AnEntry>
Expected<bool> is_free(std::string_view kind, const AnEntry& entry, const std::vector<std::string>& names) {
    const bool is_named = contains(names, entry.name);
    if (!names.empty() && !is_named) return false;
    if (entry.backend != simulated) return true;
    if (!is_named) return false;
    return failure(
        fmt::format(
            "{} '{}': --hw={} selects the real one, but backend = \"sim\" keeps it simulated: remove one of the two",
            kind, entry.name, entry.name),
        entry.place);
}

// Returns true if the robot became real.
Expected<bool> choose(RobotEntry& robot, const SystemSpec& spec, const std::vector<std::string>& names) {
    auto free = is_free("robot", robot, names);
    if (free && !*free && robot.backend != simulated)
        robot.backend.clear();  // this robot was not requested: it stays simulated
    if (!free || !*free || !robot.backend.empty()) return free;
    const auto model = spec.models.find(robot.described_by());
    robot.backend = model == spec.models.end() ? "" : model->second.hardware.backend();
    if (!robot.backend.empty()) return true;
    return failure(fmt::format("robot '{}': its model '{}' names no driver: add hardware = {{ driver = ... }} to the "
                               "model, or keep the robot simulated by backend = \"sim\"",
                               robot.name, robot.model),
                   robot.place);
}

// A component on a robot is real if the robot is.
bool is_on_simulated(const ComponentEntry& component, const SystemSpec& spec) {
    const auto* robot = find_entry<RobotEntry>(spec, component.on);
    return robot != nullptr && !robot->is_real();
}

Expected<bool> choose(ComponentEntry& component, const SystemSpec& spec, const std::vector<std::string>& names,
                      const Drivers& drivers) {
    const auto type = drivers.find(component.type);
    if (type == drivers.end() || is_on_simulated(component, spec)) return false;
    // A component is requested together with its robot.
    auto free = is_free("component", component, contains(names, component.on) ? std::vector<std::string>{} : names);
    if (free && *free && component.backend.empty()) component.backend = type->second.begin()->first;
    return free;
}

}  // namespace

Expected<void> choose_drivers(SystemSpec& spec, const std::vector<std::string>& names,
                              const decltype(Makers::components)& drivers) {
    if (auto ok = check_names(spec, names, drivers); !ok) return ok;
    bool any = false;
    // Robots first, independent of the order in the file, because their components follow them.
    for (RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        const auto real = choose(*robot, spec, names);
        if (!real) return Unexpected(real.error());
        any = any || *real;
    }
    for (ComponentEntry* component : entries_of<ComponentEntry>(spec)) {
        const auto real = choose(*component, spec, names, drivers);
        if (!real) return Unexpected(real.error());
        any = any || *real;
    }
    if (!any) return failure(fmt::format("--hw: {} has no robot or device that can be real", spec.file));
    if (spec.rate < slowest_hardware_rate)
        return failure(fmt::format("--hw: {} ticks per second are too few to drive a real robot: expected {} or more",
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
    for (RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        if (!robot->is_real()) continue;
        if (auto used = use_calibration(spec, *robot, project, {.is_needed = false, .serial = serial}); !used)
            return used;
    }
    return {};
}

void use_hardware(LiveOptions& live, const Hardware& hardware, const hw::DeviceRoots& roots) {
    live.bodies = hw::drivers(roots);
    auto drivers = hw::device_drivers(roots);
    for (const auto& [type, by_backend] : drivers) live.components[type].insert(by_backend.begin(), by_backend.end());
    live.prepare =
        [hardware, drivers = std::move(drivers),
         serial = roots.files->are_real() ? std::optional(serial_number(hardware.sys_root)) : std::nullopt,
         files = LiveOptions{.installed = live.installed, .files = live.files}](SystemSpec& spec) -> Expected<void> {
        auto ready = choose_drivers(spec, hardware.robots, drivers);
        if (ready) ready = use_calibrations(spec, files, serial);
        if (!ready || !hardware.twins) return ready;
        ready = add_twins(spec);
        return ready ? ready : failure("--twin: " + ready.error().message, ready.error().place);
    };
    live.build.real_time = true;
    live.build.out_of_time_is_fatal = false;
    live.budget = paced_budget;
}

}  // namespace nezumi::cli
