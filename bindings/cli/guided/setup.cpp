// Builds systems with the drivers that a run uses.
#include "bindings/cli/guided/setup.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/base/visible.hpp"
#include "hw/drivers.hpp"

namespace nezumi::cli {
namespace {

void say(const LogLine& line) { put_text(stderr, visible(fmt::format("{}: {}", line.component, line.text)) + "\n"); }

hw::GuidedRobot::Options options(bool real_time, const volatile std::sig_atomic_t& end) {
    return {.real_time = real_time, .end = &end, .log = say};
}

Makers makers(const Hardware& hardware) {
    Makers all;
    all.world = simulated_systems().world;
    all.bodies = hw::drivers({.dev = hardware.dev_root, .sys = hardware.sys_root});
    return all;
}

// Returns the wanted name, or the only name if none is wanted. In the error, `--KIND` is the option to choose a name.
Expected<std::string> the_one(const std::vector<std::string_view>& names, const std::string& wanted,
                              std::string_view kind, const std::string& file) {
    for (const std::string_view name : names) {
        if (name == wanted || (wanted.empty() && names.size() == 1)) return std::string(name);
    }
    if (!wanted.empty())
        return failure(
            fmt::format("there is no {} '{}' in {}{}", kind, shown(wanted), file, did_you_mean(wanted, names)));
    if (names.empty()) return failure(fmt::format("{} has no {}", file, kind));
    return failure(
        fmt::format("{} has several {}s: choose one by --{}, of {}", file, kind, kind, fmt::join(names, ", ")));
}

}  // namespace

Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_file(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end) {
    const LiveOptions live = simulated_systems();
    const Project project = Project::of(setup.file, live.installed);
    auto spec = read_system_file(setup.file, project, {.peer_words = live.peer_words});
    if (!spec) return Unexpected(spec.error());
    std::vector<std::string_view> names;
    for (const Entry& entry : spec->entries) {
        if (std::holds_alternative<RobotEntry>(entry)) names.push_back(name_of(entry));
    }
    const auto name = the_one(names, setup.name, "robot", spec->file);
    if (!name) return Unexpected(name.error());
    if (!setup.simulated) {
        if (auto ok = choose_drivers(
                *spec, {*name}, hw::device_drivers({.dev = setup.hardware.dev_root, .sys = setup.hardware.sys_root}));
            !ok)
            return Unexpected(ok.error());
        if (auto ok = use_calibrations(*spec, live, serial_number(setup.hardware.sys_root)); !ok)
            return Unexpected(ok.error());
    }
    return hw::GuidedRobot::make(std::move(*spec), *name, makers(setup.hardware), options(!setup.simulated, end));
}

Expected<std::unique_ptr<hw::GuidedCamera>> guided_camera(const GuidedSetup& setup,
                                                          const volatile std::sig_atomic_t& end) {
    const LiveOptions live = simulated_systems();
    auto spec = read_system_file(setup.file, Project::of(setup.file, live.installed), {.peer_words = live.peer_words});
    if (!spec) return Unexpected(spec.error());
    std::vector<std::string_view> names;
    for (const ComponentEntry* component : entries_of<ComponentEntry>(*spec)) {
        if (component->type == "Camera") names.push_back(component->name);
    }
    const auto name = the_one(names, setup.name, "camera", spec->file);
    if (!name) return Unexpected(name.error());
    Makers makers;
    if (setup.simulated) {
        makers.world = live.world;
        makers.components = live.components;
    } else {
        makers.components = hw::device_drivers({.dev = setup.hardware.dev_root, .sys = setup.hardware.sys_root});
    }
    return hw::GuidedCamera::make(std::move(*spec), *name, makers,
                                  {.simulated = setup.simulated, .end = &end, .log = say});
}

Expected<std::unique_ptr<hw::GuidedRobot>> guided_by_model(const std::string& model, const Hardware& hardware,
                                                           const volatile std::sig_atomic_t& end) {
    std::vector<std::filesystem::path> installed = installed_folders();
    if (installed.empty()) return failure("the installed robots can't be found: install nezumi again");
    const std::filesystem::path file = installed.front() / "engine/robots" / (model + ".lua");
    auto robot = read_robot_file(file, Project::of(file, installed));
    if (!robot) return Unexpected(robot.error());
    SystemSpec spec;
    RobotEntry entry;
    entry.name = entry.model = model;
    entry.backend = robot->hardware.driver;
    robot->drive.needs.clear();
    spec.models.emplace(model, std::move(*robot));
    spec.entries.emplace_back(std::move(entry));
    return hw::GuidedRobot::make(std::move(spec), model, makers(hardware), options(true, end));
}

}  // namespace nezumi::cli
