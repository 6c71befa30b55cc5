// An existing path is used as given; its reader reports if it is a folder or not Lua.
#include "bindings/cli/files/named_files.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <optional>
#include <system_error>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/project/near_path.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

bool has_near_name(const Error& error) { return error.message.find(" (did you mean ") != std::string::npos; }

Expected<fs::path> find_file(const std::string& given, std::initializer_list<FileKind> kinds) {
    std::error_code none;
    if (fs::exists(fs::symlink_status(given, none))) return fs::path(given);
    const bool is_path = fs::path(given).is_absolute() || given.ends_with(".lua") || given.starts_with('.');
    const Project project = Project::of("here", installed_folders());
    std::optional<Error> first;
    for (const FileKind kind : kinds) {
        if (given.empty() || fs::path(given).is_absolute()) break;
        auto found = project.find(kind, given, "here");
        if (found) return fs::path(project.shown(*found));
        // If several kinds were searched, the error with a similar name is more helpful.
        if (!first || (has_near_name(found.error()) && !has_near_name(*first))) first = found.error();
    }
    if (first && has_near_name(*first) && !fs::path(given).has_parent_path()) return Unexpected(*first);
    if (is_path || !first) return failure("there is no such file" + did_you_mean_path(given), {given});
    return Unexpected(*first);
}

}  // namespace

Expected<fs::path> find_system_file(const std::string& given) { return find_file(given, {FileKind::system}); }

Expected<fs::path> find_behavior_file(const std::string& given) { return find_file(given, {FileKind::script}); }

Expected<std::vector<fs::path>> find_lua_files(const std::string& given) {
    auto found = find_file(given, {FileKind::script, FileKind::system, FileKind::model, FileKind::module});
    if (found) return std::vector<fs::path>{std::move(*found)};
    auto scenarios = find_scenarios_called(given);
    if (scenarios || (has_near_name(scenarios.error()) && !has_near_name(found.error()))) return scenarios;
    return Unexpected(found.error());
}

std::string shipped_file_called(const std::string& name) {
    std::error_code none;
    for (const fs::path& installed : installed_folders()) {
        for (const auto& [what, folder] :
             {std::pair{"behaviour", "behaviors"}, {"system", "behaviors/systems"}, {"robot", "engine/robots"}}) {
            const fs::path file = fs::path(folder) / (name + ".lua");
            if (fs::exists(installed / file, none)) return fmt::format("the shipped {} {}", what, file.string());
        }
    }
    return "";
}

}  // namespace nezumi::cli
