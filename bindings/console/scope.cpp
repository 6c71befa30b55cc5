// The globals of a session: its own definitions, then the console's commands, then the names of the system.
#include <fmt/format.h>

#include <algorithm>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/session_parts.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/sandbox/call.hpp"

namespace nezumi {
namespace {

std::string_view key_text(lua_State* L) {
    std::size_t length = 0;
    const char* text = lua_type(L, 2) == LUA_TSTRING ? lua_tolstring(L, 2, &length) : "";
    return {text, length};
}

bool is_component(Session::Parts& parts, std::string_view name) {
    return parts.at_system([&] { return parts.live.system().find(name) != nullptr; });
}

std::string explain_unknown(Session::Parts& parts, std::string_view name) {
    std::string near = parts.at_system([&]() -> std::string {
        for (const auto& component : parts.live.system().components()) {
            const bool is_port = component->find_port(name) != nullptr;
            if (!is_port && component->parameters().find(name) == nullptr) continue;
            return fmt::format(" (did you mean '{}.{}{}'?)", component->name(), is_port ? "" : "config.", name);
        }
        return "";
    });
    const std::vector<std::string> known = names_in_scope(parts);
    if (near.empty()) near = did_you_mean(name, {known.begin(), known.end()});
    return fmt::format("unknown name '{}'{}", shown(name), near);
}

// The `__index` of the globals. Upvalues: the parts, the table of commands.
int read_global(lua_State* L) {
    Session::Parts& parts = parts_of(L);
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
    const std::string_view name = key_text(L);
    if (is_component(parts, name)) {
        parts.objects->push_component(L, parts.live, name);
        return 1;
    }
    keep_error(L, explain_unknown(parts, name));
    return raise_kept(L);
}

int assign_global(lua_State* L) {
    Session::Parts& parts = parts_of(L);
    const std::string_view name = key_text(L);
    lua_pushvalue(L, 2);
    const bool is_command = lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL;
    lua_pop(L, 1);
    if (is_command) {
        keep_error(L, fmt::format("'{}' is a command of the console: choose another name", name));
    } else if (is_component(parts, name)) {
        keep_error(L, fmt::format("'{}' is a component: choose another name", name));
    } else {
        lua_rawset(L, 1);
        return 0;
    }
    return raise_kept(L);
}

// Moves all globals into a new table, and leaves this table on the stack.
void take_globals(lua_State* L) {
    lua_newtable(L);
    const int commands = lua_gettop(L);
    lua_pushglobaltable(L);
    const int globals = lua_gettop(L);
    for (lua_pushnil(L); lua_next(L, globals) != 0;) {
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, commands);
    }
    for (lua_pushnil(L); lua_next(L, commands) != 0; lua_pop(L, 1)) {
        lua_pushvalue(L, -2);
        lua_pushnil(L);
        lua_rawset(L, globals);
    }
    lua_settop(L, commands);
}

void collect_names(lua_State* L, int table, std::vector<std::string>& names) {
    for (lua_pushnil(L); lua_next(L, table) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        std::size_t length = 0;
        const char* text = lua_tolstring(L, -2, &length);
        names.emplace_back(text, length);
    }
}

constexpr char commands_key = 0;  // its address is a key of the registry

}  // namespace

Expected<void> open_scope(Session::Parts& parts) {
    const auto opened = protect(parts.state->lua(), Budget{10.0}, [&parts](lua_State* L) {
        take_globals(L);
        add_console_commands(L, parts);
        parts.objects->push_system(L, parts.live);
        lua_pushvalue(L, -1);
        lua_setfield(L, -3, "world");
        lua_setfield(L, -2, "system");
        push_hosts(L, *parts.objects, parts.live);
        lua_setfield(L, -2, "hosts");
        lua_pushvalue(L, -1);
        lua_rawsetp(L, LUA_REGISTRYINDEX, &commands_key);
        const int commands = lua_gettop(L);
        lua_pushglobaltable(L);
        lua_createtable(L, 0, 3);
        lua_pushlightuserdata(L, &parts);
        lua_pushvalue(L, commands);
        lua_pushcclosure(L, read_global, 2);
        lua_setfield(L, -2, "__index");
        lua_pushlightuserdata(L, &parts);
        lua_pushvalue(L, commands);
        lua_pushcclosure(L, assign_global, 2);
        lua_setfield(L, -2, "__newindex");
        lua_pushboolean(L, 0);
        lua_setfield(L, -2, "__metatable");
        lua_setmetatable(L, -2);
        return 0;
    });
    if (!opened) return Unexpected(opened.error());
    return {};
}

void push_commands_table(lua_State* L) { lua_rawgetp(L, LUA_REGISTRYINDEX, &commands_key); }

std::vector<std::string> component_names(Session::Parts& parts) {
    return parts.at_system([&] {
        std::vector<std::string> names;
        for (const auto& component : parts.live.system().components()) names.push_back(component->name());
        return names;
    });
}

std::vector<std::string> names_in_scope(Session::Parts& parts) {
    std::vector<std::string> names = component_names(parts);
    std::erase_if(names,
                  [](const std::string& name) { return is_remote(name); });  // only within texts: "ev3/vehicle.out"
    lua_State* L = parts.state->lua();
    const int top = lua_gettop(L);
    if (lua_checkstack(L, 6) != 0) {
        push_commands_table(L);
        collect_names(L, lua_gettop(L), names);
        lua_pushglobaltable(L);
        collect_names(L, lua_gettop(L), names);
    }
    lua_settop(L, top);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

}  // namespace nezumi
