// `nezumi list`: lists systems, robots, behaviours, messages, modules and scenarios of the project and the installed
// ones.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "bindings/lua/syntax/first_comment.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/find_files.hpp"
#include "engine/base/list.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kinds{"systems", "robots",    "behaviors",   "messages",
                                                "modules", "scenarios", "environments"};

struct Named {
    std::string file, doc;
};
// The listed files of one kind, by name.
using Listing = std::map<std::string, Named>;

// The name that other files use: a module's path below `behaviors/` or `behaviors/lib/`, otherwise the file's name.
std::string listed_name(const fs::path& file, const fs::path& root, LuaKind kind) {
    if (kind == LuaKind::message) return type_of_file(file.string());
    if (kind != LuaKind::module) return file.stem().string();
    std::string name = file.lexically_relative(root / "behaviors").replace_extension().string();
    if (name.starts_with("lib/")) name.erase(0, 4);
    std::replace(name.begin(), name.end(), '/', '.');
    return name;
}

std::string first_line_of(std::string_view text) {
    const std::string comment = first_comment(text);
    return visible_message(comment.substr(0, comment.find('\n')));
}

// Adds the files of a project, or of an installation, except files with the name of an earlier file.
void add_files(const fs::path& root, const Project& project, std::map<std::string_view, Listing>& all) {
    for (const char* folder : {"behaviors", "engine/robots"}) {
        for (const fs::path& file : find_files(root / folder, ".lua").files) {
            const auto text = read_whole(file, file.string());
            if (!text) continue;
            const LuaKind kind = kind_of_file(file, *text);
            if (kind_name(kind).empty() || kind == LuaKind::scenario) continue;
            all[kind_name(kind)].try_emplace(listed_name(file, root, kind),
                                             Named{project.shown(file), first_line_of(*text)});
        }
    }
}

void add_scenarios(const Project& project, Listing& scenarios) {
    const auto files = find_scenario_files({});
    if (!files) return;
    for (const fs::path& file : *files) {
        const auto text = read_whole(file, file.string());
        if (text) scenarios.try_emplace(file.stem().string(), Named{project.shown(file), first_line_of(*text)});
    }
}

void print(const Listing& listing, std::string_view indent) {
    std::size_t width = 0;
    for (const auto& [name, named] : listing) width = std::max(width, name.size());
    for (const auto& [name, named] : listing) {
        fmt::print("{}{:<{}}  {}{}\n", indent, name, width, named.file, named.doc.empty() ? "" : ": " + named.doc);
    }
}

int list(const std::string& kind) {
    if (!kind.empty() && !contains(kinds, kind))
        return refuse(fmt::format("list: there is no kind '{}'{}: expected {}", shown(kind),
                                  did_you_mean(kind, {kinds.begin(), kinds.end()}), fmt::join(kinds, ", ")));
    const Project project = Project::of("here", installed_folders());
    std::map<std::string_view, Listing> all;
    if (!project.root().empty()) add_files(project.root(), project, all);
    for (const fs::path& root : project.installed()) add_files(root, project, all);
    add_scenarios(project, all["scenarios"]);
    if (!kind.empty()) {
        print(all[kind], "");
        return exit_done;
    }
    for (const std::string_view each : kinds) {
        if (all[each].empty()) continue;
        fmt::print("{}\n", each);
        print(all[each], "  ");
    }
    return exit_done;
}

}  // namespace

SubCommand list_command() {
    auto kind = std::make_shared<std::string>();
    return {
        .name = "list",
        .help =
            "Show the systems, robots, behaviours, messages, modules, scenarios and environments of the project and "
            "the "
            "installed ones",
        .options = {{"[KIND]", kind.get(), "only " + fmt::format("{}", fmt::join(kinds, ", "))}},
        .run = [kind] { return list(*kind); },
        .footer = "A line for each: its name, its file, and the first line of the comment that the file begins with."};
}

}  // namespace nezumi::cli
