// Counts the globals of behaviours and those of system files that a Lua file uses.
#include "bindings/cli/files/lua_kind.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "engine/base/list.hpp"

namespace nezumi::cli {
namespace {

// True if the file ends by returning a value, as modules do.
bool returns(const SyntaxTree& tree) {
    const SyntaxNode& root = tree.root();
    return std::any_of(begin(root), end(root),
                       [](const SyntaxNode& statement) { return statement.is(SyntaxNode::Kind::return_statement); });
}

}  // namespace

LuaKind kind_of_file(const std::filesystem::path& path, std::string_view text) {
    if (path.stem().string().ends_with("_test")) return LuaKind::scenario;
    if (text.starts_with("---@meta")) return LuaKind::definitions;
    if (path.stem().extension() == ".calibration") return LuaKind::calibration;
    const std::string folder = path.parent_path().filename().string();

    const std::vector<std::string_view> words = system_word_names(peer_words());
    int of_behaviors = 0;
    int of_systems = 0;
    bool declares = false;
    const SyntaxTree tree(without_preamble(text));
    for (const GlobalUse& use : global_uses(tree)) {
        if (use.name() == "robot_model") return LuaKind::robot;
        if (use.name() == "message" && returns(tree)) return LuaKind::message;
        if (use.name() == "scenario") return LuaKind::scenario;
        if (use.name() == "environment") return LuaKind::environment;
        if (use.name() == "calibration") return LuaKind::calibration;
        if (use.assigned && use.name().starts_with("on_")) declares = true;
        if (contains(script_globals(), use.name()) && use.name() != "require") ++of_behaviors;
        if (contains(words, use.name())) ++of_systems;
    }
    if (folder == "messages") return LuaKind::message;
    if (!declares && folder == "robots") return LuaKind::robot;
    if (!declares && returns(tree)) return of_systems > of_behaviors ? LuaKind::system_module : LuaKind::module;
    if (declares || of_behaviors > of_systems) return LuaKind::behavior;
    return of_systems > of_behaviors || folder == "systems" ? LuaKind::system : LuaKind::behavior;
}

Error explain_system_error(Error error) {
    constexpr std::string_view begin = "unknown global '";
    if (!error.message.starts_with(begin)) return error;
    const std::string name = error.message.substr(begin.size(), error.message.find('\'', begin.size()) - begin.size());
    const auto& globals = script_globals();
    if (name == "scenario") {
        error.message += ": it is for scenarios; try `nezumi test`";
    } else if (name == "robot_model") {
        error.message += ": it is for robot files; in a system file write `robot NAME { model = ... }`";
    } else if (name.starts_with("on_") || contains(globals, name)) {
        error.message += ": it is for behaviours; in a system file write `behavior NAME { script = ... }`";
    }
    return error;
}

std::string_view kind_name(LuaKind kind) {
    switch (kind) {
        case LuaKind::system: return "systems";
        case LuaKind::robot: return "robots";
        case LuaKind::behavior: return "behaviors";
        case LuaKind::module: return "modules";
        case LuaKind::message: return "messages";
        case LuaKind::scenario: return "scenarios";
        case LuaKind::environment: return "environments";
        default: return "";
    }
}

}  // namespace nezumi::cli
