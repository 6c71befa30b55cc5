// Takes the specification that the system was built from, and brings it up to date.
#include "bindings/console/save_system.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/files/system_text.hpp"

namespace nezumi {
namespace {

// The values that the file would give when it is read: its set over its config over the defaults.
ParameterValues configured_values(const Component& component) {
    ParameterValues values;
    for (const auto& parameter : component.parameters().all()) {
        const std::string& name = parameter.spec.name;
        values[name] = parameter.spec.initial;
        const auto take = [&](const ParameterValues& from) {
            const auto found = from.find(name);
            if (found == from.end()) return;
            if (auto value = check_value(parameter.spec, found->second)) values[name] = *value;
        };
        take(component.configured);
        const auto set = component.sets.find(component.set_in_use());
        if (set != component.sets.end()) take(set->second);
    }
    return values;
}

bool is_as_configured(const Component& component) {
    const ParameterValues values = configured_values(component);
    for (const auto& parameter : component.parameters().all()) {
        if (values.at(parameter.spec.name) != parameter.value) return false;
    }
    return true;
}

ParameterValues present_values(const Component& component, const ParameterValues& config) {
    ParameterValues values;
    for (const auto& parameter : component.parameters().all()) {
        const bool differs = parameter.value != parameter.spec.initial;
        if (differs || config.contains(parameter.spec.name)) values[parameter.spec.name] = parameter.value;
    }
    return values;
}

void bring_up_to_date(RobotEntry&, const Component&) {}

void bring_up_to_date(BehaviorEntry& entry, const Component& component) {
    entry.set = component.set_in_use();
    if (is_as_configured(component)) return;
    entry.config = present_values(component, entry.config);
    entry.set.clear();  // its values are among these
}

void bring_up_to_date(ComponentEntry& entry, const Component& component) {
    if (!is_as_configured(component)) entry.config = present_values(component, entry.config);
}

Expected<void> write_file(const std::filesystem::path& path, const std::string& text) {
    const std::filesystem::path fresh = path.string() + ".new";
    {
        std::ofstream file(fresh, std::ios::binary);
        file << text;
        file.flush();
        if (!file) return failure(fmt::format("{} can't be written: {}", path.string(), std::strerror(errno)));
    }
    std::error_code problem;
    std::filesystem::rename(fresh, path, problem);
    if (problem) return failure(fmt::format("{} can't be written: {}", path.string(), problem.message()));
    return {};
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

SystemSpec present_spec(const LiveSystem& live) {
    const System& system = live.system();
    SystemSpec spec = live.spec();
    std::erase_if(spec.entries, [&](const Entry& entry) { return system.find(name_of(entry)) == nullptr; });
    for (Entry& entry : spec.entries) {
        std::visit([&](auto& each) { bring_up_to_date(each, *system.find(each.name)); }, entry);
    }
    spec.connections.clear();
    for (const Connection& connection : system.connections()) {
        spec.connections.push_back({connection.from_component->name() + "." + connection.from->name(),
                                    connection.to_component->name() + "." + connection.to->name(),
                                    {}});
    }
    return spec;
}

Expected<std::string> save_system(const LiveSystem& live, const std::string& file) {
    std::filesystem::path path = file;
    if (path.filename().empty()) return failure(fmt::format("'{}' names no file", file));
    if (!path.has_extension()) path += ".lua";
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem)) return failure(fmt::format("'{}' is a folder", path.string()));
    const SystemSpec spec = present_spec(live);
    const std::string title =
        spec.file.empty() ? "A system, saved from the console." : fmt::format("{}, saved from the console.", spec.file);
    const std::string text = write_system_text(spec, title);
    const Project project = Project::of(path, live.options().installed);
    if (auto back = read_system_text(text, path.string(), project); !back) {
        return failure(
            fmt::format("nothing is saved, since {} could not be read: {}", path.string(), back.error().message));
    }
    const bool existed = std::filesystem::exists(path, problem);
    const std::string before = path.string() + "~";
    if (existed) {
        std::filesystem::copy_file(path, before, std::filesystem::copy_options::overwrite_existing, problem);
        if (problem)
            return failure(fmt::format("{} can't be kept as {}: {}", path.string(), before, problem.message()));
    }
    if (auto ok = write_file(path, text); !ok) return Unexpected(ok.error());
    return fmt::format("saved {}: {}, {}{}", path.string(), counted(spec.entries.size(), "component"),
                       counted(spec.connections.size(), "connection"),
                       existed ? fmt::format("; what was there is now {}", before) : "");
}

}  // namespace nezumi
