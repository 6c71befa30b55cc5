// `nezumi types`: the message types, as a table or as annotations for an editor.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/lua/files/message_file.hpp"
#include "bindings/lua/stubs/annotations.hpp"
#include "bindings/lua/stubs/type_table.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "engine/base/list.hpp"
#include "engine/messages/message_files.hpp"

namespace nezumi::cli {
namespace {

struct TypesOptions {
    std::vector<std::string> names;
    bool lua = false;
};

// Shows the project's types with their fields, and only the names of the many installed ones.
int show_all(const MessageFiles& files) {
    const MessageFiles of_project(Project::of("here", {}), read_message_file);
    const std::vector<std::string> own = of_project.names("here");
    std::vector<std::string> installed;
    for (std::string& name : files.names("here")) {
        if (!contains(own, name)) installed.push_back(std::move(name));
    }
    fmt::print("{}", type_table(of_project.all("here")));
    if (!installed.empty())
        fmt::print("\nInstalled definitions, used like the others (`nezumi types NAME` shows one):\n  {}\n",
                   fmt::join(installed, "\n  "));
    return exit_done;
}

int show_types(const TypesOptions& options) {
    if (options.lua && !options.names.empty()) return refuse("types: --lua writes all types: leave out the names");
    const MessageFiles files(Project::of("here", installed_folders()), read_message_file);
    if (options.lua) {
        fmt::print("{}", annotations(scenario_records(), peer_words(), files.all("here")));
        return exit_done;
    }
    if (options.names.empty()) return show_all(files);
    std::string text;
    for (const std::string& name : options.names) {
        const auto found = files.find(name, "here");
        if (!found) return refuse("types: " + describe(found.error()));
        text += (text.empty() ? "" : "\n") + type_table(*found->type);
    }
    fmt::print("{}", text);
    return exit_done;
}

}  // namespace

SubCommand types_command() {
    auto options = std::make_shared<TypesOptions>();
    return {.name = "types",
            .help = "Show the message types with their fields, units and limits",
            .options = {{"[TYPE]", &options->names, "only these types"},
                        {"--lua", &options->lua, "write annotations for the Lua language server (LuaLS)"}},
            .run = [options] { return show_types(*options); }};
}

}  // namespace nezumi::cli
