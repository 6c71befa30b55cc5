#include "bindings/cli/files/page_editor.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "bindings/lua/files/message_file.hpp"
#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/lua/stubs/annotations.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "engine/messages/message_files.hpp"

namespace nezumi::cli {
namespace {

// The global names that each kind of file may use.
std::map<std::string, std::vector<std::string>> names_of_files() {
    std::map<std::string, std::vector<std::string>> names;
    const auto add = [&](LuaKind kind, const auto& words) {
        std::vector<std::string>& all = names[std::string(kind_name(kind))];
        if (all.empty()) {
            const KnownGlobals& library = sandbox_globals();
            all.assign(library.readable.begin(), library.readable.end());
        }
        all.insert(all.end(), words.begin(), words.end());
    };
    add(LuaKind::behavior, script_globals());
    add(LuaKind::behavior, hook_names());
    add(LuaKind::module, std::vector<std::string>{"require"});
    add(LuaKind::system, system_word_names(peer_words()));
    add(LuaKind::robot, std::vector<std::string>{"robot_model"});
    add(LuaKind::scenario, std::vector<std::string>{"scenario", "range"});
    add(LuaKind::environment, std::vector<std::string>{"environment", "require"});
    return names;
}

}  // namespace

web::EditorOptions editor_of(const Project& project) {
    return {.kind = [](const std::filesystem::path& file,
                       const std::string& text) { return std::string(kind_name(kind_of_file(file, text))); },
            .words =
                [project] {
                    const MessageFiles messages(project, read_message_file);
                    return web::EditorWords{.annotations = annotations(scenario_records(), peer_words(),
                                                                       messages.all(project.root() / "here")),
                                            .names = names_of_files()};
                }};
}

}  // namespace nezumi::cli
