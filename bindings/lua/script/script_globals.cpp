// Every global function is a C function with its script as an upvalue. It reads from Lua without raising errors, and
// raises an error only at its end, when its C++ objects are destroyed.
#include "bindings/lua/script/script_globals.hpp"

#include <fmt/format.h>

#include "bindings/lua/modules/native_modules.hpp"
#include "bindings/lua/sandbox/inspect.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/script/script_call.hpp"
#include "bindings/lua/script/script_config.hpp"
#include "bindings/lua/script/script_declarations.hpp"
#include "bindings/lua/script/task_globals.hpp"

namespace nezumi {
namespace {

// The addresses of these variables are keys of the registry.
constexpr char state_key = 0;
constexpr char modules_key = 0;

// now(), log.*

int global_now(lua_State* L) {
    bridge(L, [L] { return Arguments{L}.at_most("now", 0, "()"); });
    script_of(L).note_look_at_tick();
    lua_pushnumber(L, script_of(L).seconds());
    return 1;
}

template <LogLevel level>
int global_log(lua_State* L) {
    push_line(L);
    script_of(L).log(level, std::string(string_at(L, -1)));
    return 0;
}

int unknown_level(lua_State* L) {
    push_text(L, 2);
    return bridge(L, [&]() -> Expected<void> {
        const std::string_view name = string_at(L, -1);
        const std::string near = did_you_mean(name, {"debug", "info", "warn", "error"});
        return failure(
            fmt::format("log has no '{}'{}", name, near.empty() ? " (it has debug, info, warn, error)" : near));
    });
}

void push_log(lua_State* L, Script& script) {
    lua_createtable(L, 0, 4);
    set_function(L, script, "debug", global_log<LogLevel::debug>);
    set_function(L, script, "info", global_log<LogLevel::info>);
    set_function(L, script, "warn", global_log<LogLevel::warn>);
    set_function(L, script, "error", global_log<LogLevel::error>);
    lua_createtable(L, 0, 1);
    set_function(L, script, "__index", unknown_level);
    lua_setmetatable(L, -2);
    lock_table(L, "log");
}

int end_module(lua_State* L) {
    script_of(L).end_module();
    return 0;
}

// Pushes a to-be-closed value that calls `Script::end_module`, also if loading the module fails and the script catches
// the error with pcall.
void push_module_end(lua_State* L) {
    lua_newuserdatauv(L, 0, 0);
    lua_createtable(L, 0, 1);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushcclosure(L, end_module, 1);
    lua_setfield(L, -2, "__close");
    lua_setmetatable(L, -2);
}

// require(name)
int global_require(lua_State* L) {
    Script& script = script_of(L);
    bridge(L, [L] { return Arguments{L}.at_most("require", 1, "(name)"); });
    lua_settop(L, 1);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &modules_key);
    if (lua_type(L, 1) == LUA_TSTRING) {
        lua_pushvalue(L, 1);
        if (lua_rawget(L, 2) != LUA_TNIL) return 1;
        lua_pop(L, 1);
    }
    if (!push_native_module(L, 1)) {
        push_module_end(L);
        bridge(L, [&]() -> Expected<void> {
            if (lua_type(L, 1) != LUA_TSTRING)
                return failure(fmt::format("require expected a module's name, got {}", luaL_typename(L, 1)));
            return script.begin_module(string_at(L, 1));
        });
        lua_toclose(L, 3);
        const Chunk& chunk = script.module_chunk();
        if (luaL_loadbufferx(L, chunk.bytecode.data(), chunk.bytecode.size(), "module", "b") != LUA_OK) lua_error(L);
        const int arguments = script.push_module_marks(L);
        if (is_outside_coroutines(L)) {
            lua_call(L, arguments, 1);
        } else if (lua_pcall(L, arguments, 1, 0) != LUA_OK) {  // in a coroutine, an error alone closes nothing
            lua_closeslot(L, 3);
            lua_error(L);
        }
        lua_closeslot(L, 3);
    }
    if (lua_isnil(L, -1)) {
        lua_pop(L, 1);
        lua_pushboolean(L, 1);
    }
    lua_pushvalue(L, 1);
    lua_pushvalue(L, -2);
    lua_rawset(L, 2);
    return 1;
}

// Assignments to globals: callbacks are accepted, everything else is a mistake.

int global_newindex(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    std::size_t hook = 0;
    int line = 0;
    bridge(L, [&]() -> Expected<void> {
        line = caller(L).line;
        const std::string_view name = string_at(L, -1);
        const auto found = script.check_hook(name, luaL_typename(L, 3));
        if (!found) return Unexpected(found.error());
        hook = *found;
        const int given = hook == static_cast<std::size_t>(Hook::on_reload) ? 1 : 0;
        if (auto ok = check_parameters(L, 3, given); !ok)
            return failure(fmt::format("{}: {}", name, ok.error().message));
        return {};
    });
    lua_pushvalue(L, 3);
    script.set_hook(hook, luaL_ref(L, LUA_REGISTRYINDEX), line);
    return 0;
}

// `__index` of the globals: finds `dt`, callbacks, and globals that do not exist before their first use.
int global_index(lua_State* L) {
    Script& script = script_of(L);
    if (lua_type(L, 2) == LUA_TSTRING && string_at(L, 2) == "dt") {
        lua_pushnumber(L, script.dt());
        return 1;
    }
    push_text(L, 2);
    if (string_at(L, -1) == "state") {  // before it is set
        script.note_look_at_tick();
        set_state_global(L, nullptr);
        push_state(L);
        return 1;
    }
    // Most scripts use few libraries, no tasks and no probes, so these are created when they are used.
    if (open_library(L, string_at(L, -1))) {
        lua_pushglobaltable(L);
        lua_pushvalue(L, 2);
        lua_rawget(L, -2);
        return 1;
    }
    const bool probes = string_at(L, -1) == "probe";
    if (probes || is_task_global(string_at(L, -1))) {
        lua_pushglobaltable(L);
        probes ? set_probe_global(L, script) : set_task_globals(L, script);
        lua_pushvalue(L, 2);
        lua_rawget(L, -2);
        return 1;
    }
    const int function = script.hook_function(string_at(L, -1));
    if (function == LUA_REFNIL) {
        lua_pushnil(L);
        return 1;
    }
    if (function != LUA_NOREF) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, function);
        return 1;
    }
    return bridge(L, [&]() -> Expected<void> {
        const std::string_view name = string_at(L, -1);
        return failure(fmt::format("unknown global '{}'{}", name, did_you_mean(name, script_globals())));
    });
}

}  // namespace

void install_globals(lua_State* L, Script& script) {
    luaL_checkstack(L, 12, nullptr);
    lua_newtable(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &modules_key);
    lua_pushglobaltable(L);
    set_declaring_globals(L, script);
    set_function(L, script, "now", global_now);
    set_function(L, script, "require", global_require);
    push_log(L, script);
    lua_setfield(L, -2, "log");
    push_config(L, script);
    lua_setfield(L, -2, "config");

    lua_createtable(L, 0, 3);
    set_function(L, script, "__index", global_index);
    set_function(L, script, "__newindex", global_newindex);
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
}

void set_state_global(lua_State* L, const PlainData* state) {
    luaL_checkstack(L, 4, nullptr);
    lua_pushglobaltable(L);
    lua_pushliteral(L, "state");
    if (state != nullptr) {
        push_plain(L, *state);
    } else {
        lua_newtable(L);
    }
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &state_key);
    lua_rawset(L, -3);
    lua_pop(L, 1);
}

const std::vector<std::string_view>& script_globals() {
    static const std::vector<std::string_view> globals{
        "about",  "cancel", "command", "config",  "constants", "dt",    "input", "log",  "now",
        "output", "param",  "probe",   "require", "start",     "state", "task",  "wait", "wait_until"};
    return globals;
}

void push_state(lua_State* L) { lua_rawgetp(L, LUA_REGISTRYINDEX, &state_key); }

}  // namespace nezumi
