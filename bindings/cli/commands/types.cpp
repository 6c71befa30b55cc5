// `nezumi types`: the message types, as a table or as annotations for an editor.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/lua/stubs/annotations.hpp"
#include "bindings/lua/stubs/type_table.hpp"
#include "bindings/scenario/scenario_fields.hpp"

namespace nezumi::cli {
namespace {

struct TypesOptions {
    std::vector<std::string> names;
    bool lua = false;
};

int show_types(const TypesOptions& options) {
    if (options.lua && !options.names.empty()) return refuse("types: --lua writes all types: leave out the names");
    if (options.lua) {
        fmt::print("{}", annotations(scenario_records()));
        return exit_done;
    }
    if (options.names.empty()) {
        fmt::print("{}", type_table());
        return exit_done;
    }
    const std::span<const MessageInfo> messages = message_infos();
    std::string text;
    for (const std::string& name : options.names) {
        const auto found = std::find_if(messages.begin(), messages.end(),
                                        [&](const MessageInfo& message) { return message.name == name; });
        if (found == messages.end()) {
            return refuse(fmt::format("types: there is no message type '{}'{}; `nezumi types` shows all", shown(name),
                                      did_you_mean(name, {message_type_names.begin(), message_type_names.end()})));
        }
        text += (text.empty() ? "" : "\n") + type_table(*found);
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
