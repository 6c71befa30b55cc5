// What is there is meant, whatever it is: that it is a folder, or no Lua, is for the reader to say.
#include "bindings/cli/named_files.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "bindings/cli/environment.hpp"
#include "bindings/lua/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

// "(did you mean 'near.lua'?)" among the files of the folder where this one is not.
std::string near_file(const fs::path& path) {
    std::vector<std::string> names;
    std::error_code problem;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
        names.push_back(entry->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return did_you_mean(path.filename().string(), {names.begin(), names.end()});
}

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
        // Of several kinds the one that knows a near name says more.
        const bool is_near = found.error().message.find(" (did you mean ") != std::string::npos;
        if (!first || (is_near && first->message.find(" (did you mean ") == std::string::npos)) first = found.error();
    }
    if (is_path || !first) return failure("there is no such file" + near_file(given), {given});
    return Unexpected(*first);
}

}  // namespace

Expected<fs::path> find_system_file(const std::string& given) { return find_file(given, {FileKind::system}); }

Expected<fs::path> find_lua_file(const std::string& given) {
    return find_file(given, {FileKind::script, FileKind::system, FileKind::model});
}

}  // namespace nezumi::cli
