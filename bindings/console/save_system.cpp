// Updates the specification that the system was built from.
#include "bindings/console/save_system.hpp"

#include <fmt/format.h>

#include "bindings/console/file_to_write.hpp"
#include "bindings/lua/files/change_robot.hpp"
#include "bindings/lua/files/robot_parameters.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/files/system_text.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/system/network.hpp"
#include "engine/system/peer_word.hpp"
#include "engine/system/script_drivers.hpp"

namespace nezumi {
namespace {

// Puts each value that differs from the file into the parameter set in use if the set has it, otherwise into `config`.
// Removes values of parameters that no longer exist.
void bring_up_to_date(ParameterValues& config, ParameterValues* set, const Component& component) {
    for (const auto& parameter : component.parameters().all()) {
        const std::string& name = parameter.spec.name;
        if (parameter.value == component.configured_value(parameter.spec)) continue;
        (set != nullptr && set->contains(name) ? *set : config)[name] = parameter.value;
    }
    std::erase_if(config, [&](const auto& given) {
        const auto* parameter = component.parameters().find(given.first);
        return parameter == nullptr || !check_value(parameter->spec, given.second);
    });
}

Expected<void> bring_up_to_date(RobotEntry& entry, const Component& component, const RunningSystem& live) {
    for (const auto& parameter : component.parameters().all()) {
        if (parameter.value == parameter.spec.initial) continue;
        const auto field =
            field_of_parameter(live.spec().models.at(entry.described_by()), parameter.spec.name, parameter.value);
        if (!field) return Unexpected(field.error());
        const auto all = changes_with(entry, *field, live.project());
        if (!all) return Unexpected(all.error());
        entry.changes = to_lua(*all);
    }
    return {};
}

Expected<void> bring_up_to_date(BehaviorEntry& entry, const Component& component, const RunningSystem& /*live*/) {
    entry.set = component.set_in_use();
    const auto set = entry.sets.find(entry.set);
    bring_up_to_date(entry.config, set != entry.sets.end() ? &set->second : nullptr, component);
    return {};
}

Expected<void> bring_up_to_date(ComponentEntry& entry, const Component& component, const RunningSystem& /*live*/) {
    bring_up_to_date(entry.config, nullptr, component);
    return {};
}

// The name of `file` as a person would write it in the file `named_in`: the shortest name that finds it, its relative
// path if both files are in the project, or its whole path.
std::string name_of(const Project& project, const std::filesystem::path& file, const std::filesystem::path& named_in) {
    const std::filesystem::path working = project.files().working_folder();
    const auto whole = (working / file).lexically_normal();
    const auto naming = (working / named_in).lexically_normal().parent_path();
    std::vector<std::filesystem::path> folders{naming};
    if (!project.root().empty()) folders.push_back(project.root() / "behaviors");
    for (const auto& installed : project.installed()) folders.push_back(installed / "behaviors");
    for (const auto& folder : folders) {
        std::string name = whole.lexically_relative(folder).generic_string();
        if (name.empty() || name.starts_with("..")) continue;
        if (const auto found = project.find(FileKind::data, name, named_in); found && *found == whole) return name;
    }
    const auto is_inside = [&](const std::filesystem::path& path) {
        return !project.root().empty() && *path.lexically_relative(project.root()).begin() != "..";
    };
    return (is_inside(whole) && is_inside(naming) ? whole.lexically_relative(naming) : whole).generic_string();
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// Removes the simulated twins of real robots: they belong to the run, not to the system file.
void leave_out_twins(SystemSpec& spec) {
    std::vector<std::string> twins;
    for (const RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        if (!robot->twin_of.empty()) twins.push_back(robot->name);
    }
    for (const std::string& twin : twins) {
        const std::string ports = twin + ".";
        std::erase_if(spec.entries, [&](const Entry& entry) { return name_of(entry) == twin; });
        std::erase_if(spec.connections, [&](const ConnectionSpec& connection) {
            return connection.from.starts_with(ports) || connection.to.starts_with(ports);
        });
    }
}

// Removes the names of components that no longer exist from the descriptions of peers.
void leave_out_missing(SystemSpec& spec) {
    const auto peers = spec.peers;  // a copy, because each peer may replace its entry in `spec`
    for (const auto& [name, peer] : peers) peer->word().remove_missing(spec);
}

// The name of the behaviour that uses this script; "" if there is none.
std::string user_of_script(const SystemSpec& spec, const std::filesystem::path& file) {
    for (const BehaviorEntry* behavior : entries_of<BehaviorEntry>(spec)) {
        std::error_code none;
        if (std::filesystem::equivalent(behavior->path, file, none)) return behavior->name;
    }
    return "";
}

}  // namespace

Expected<PresentSystem> present_system(const RunningSystem& live) {
    const System& system = live.system();
    SystemSpec spec = live.spec();
    std::erase_if(spec.entries, [&](const Entry& entry) { return system.find(name_of(entry)) == nullptr; });
    spec.connections = system.connections();
    std::erase_if(spec.connections, [&](const ConnectionSpec& connection) {
        return system.network() != nullptr && system.network()->brought(connection);
    });
    const auto& foreign = system.foreign_connections();
    spec.connections.insert(spec.connections.end(), foreign.begin(), foreign.end());
    leave_out_missing(spec);
    leave_out_twins(spec);
    leave_out_script_drivers(spec);
    for (Entry& entry : spec.entries) {
        const auto done = std::visit(
            [&](auto& each) {
                const Component& component = *system.find(each.name);
                each.active = component.state() != LifeState::inactive;  // a component in ERROR is saved as active
                return bring_up_to_date(each, component, live);
            },
            entry);
        if (!done) return Unexpected(done.error());
    }
    return PresentSystem{std::move(spec), live.project(), live.options().installed, live.options().peer_words};
}

Expected<std::string> save_system(PresentSystem present, const std::string& file) {
    const auto named =
        file_to_write(writable_folder(present.project, present.spec.file), file,
                      {.word = "save", .file = "a system file", .what = "a system", .endings = {".lua"}});
    if (!named) return Unexpected(named.error());
    const std::filesystem::path& path = *named;
    if (const std::string user = user_of_script(present.spec, path); !user.empty()) {
        return failure(
            fmt::format("'{}' is the script of {}: give the system's file another name", path.string(), user));
    }
    const Project project = Project::of(path, present.installed);
    SystemSpec& spec = present.spec;
    if (spec.arena.floor) spec.arena.floor->image = name_of(project, spec.arena.floor->image, path);
    const std::string title = spec.file.empty() ? "A system, saved from the console."
                                                : fmt::format("The system of {}, saved from the console.", spec.file);
    const std::string text = write_system_text(spec, title);
    if (auto back = read_system_text(text, path.string(), project, {.peer_words = present.peer_words}); !back) {
        return failure(fmt::format("nothing was saved, because {} could not be read again: {}", path.string(),
                                   back.error().message));
    }
    std::error_code problem;
    const bool existed = std::filesystem::exists(path, problem);
    const std::string before = path.string() + "~";
    if (auto ok = write_whole(path, text, before); !ok) return failure(describe(ok.error()));
    return fmt::format("saved {}: {}, {}{}", path.string(), counted(spec.entries.size(), "component"),
                       counted(spec.connections.size(), "connection"),
                       existed ? fmt::format("; the previous file is now {}", before) : "");
}

}  // namespace nezumi
