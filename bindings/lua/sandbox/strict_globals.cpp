// A metatable for the globals.
#include "bindings/lua/sandbox/strict_globals.hpp"

#include <algorithm>
#include <cstdio>

#include "bindings/lua/sandbox/call.hpp"

namespace nezumi {
namespace {

constexpr int callbacks_index = lua_upvalueindex(1);  // a table from the name of each callback to true

bool is_callback(lua_State* lua, int key) {
    lua_pushvalue(lua, key);
    lua_rawget(lua, callbacks_index);
    const bool is = lua_toboolean(lua, -1) != 0;
    lua_pop(lua, 1);
    return is;
}

void collect_names(lua_State* lua, int table, std::vector<std::string_view>& names) {
    lua_pushvalue(lua, table);
    for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1)) {
        std::size_t length = 0;
        if (lua_type(lua, -2) != LUA_TSTRING) continue;
        const char* name = lua_tolstring(lua, -2, &length);
        names.emplace_back(name, length);
    }
    lua_pop(lua, 1);
}

// A separate function, so that no object is left to destroy when the error is raised.
void write_complaint(lua_State* lua, char* text, std::size_t size) noexcept {
    std::size_t length = 0;
    const char* name = lua_type(lua, 2) == LUA_TSTRING ? lua_tolstring(lua, 2, &length) : luaL_typename(lua, 2);
    std::vector<std::string_view> names;
    collect_names(lua, 1, names);
    collect_names(lua, callbacks_index, names);
    std::sort(names.begin(), names.end());
    std::snprintf(text, size, "unknown global '%.100s'%s", name, did_you_mean(name, names).c_str());
}

int refuse(lua_State* lua) {
    char text[300];
    luaL_checkstack(lua, 4, nullptr);
    write_complaint(lua, text, sizeof text);
    return luaL_error(lua, "%s", text);
}

int read_unknown(lua_State* lua) {
    if (!is_callback(lua, 2)) return refuse(lua);
    lua_pushnil(lua);
    return 1;
}

int assign_unknown(lua_State* lua) {
    if (!is_callback(lua, 2)) return refuse(lua);
    lua_rawset(lua, 1);
    return 0;
}

}  // namespace

Expected<void> make_globals_strict(lua_State* lua, const std::vector<std::string_view>& callbacks) {
    const auto made = protect(lua, Budget{10.0}, [&callbacks](lua_State* inside) {
        lua_pushglobaltable(inside);
        lua_createtable(inside, 0, 3);
        lua_createtable(inside, 0, static_cast<int>(callbacks.size()));
        for (const std::string_view name : callbacks) {
            lua_pushlstring(inside, name.data(), name.size());
            lua_pushboolean(inside, 1);
            lua_rawset(inside, -3);
        }
        lua_pushvalue(inside, -1);
        lua_pushcclosure(inside, read_unknown, 1);
        lua_setfield(inside, -3, "__index");
        lua_pushcclosure(inside, assign_unknown, 1);
        lua_setfield(inside, -2, "__newindex");
        lua_pushboolean(inside, 0);
        lua_setfield(inside, -2, "__metatable");
        lua_setmetatable(inside, -2);
        return 0;
    });
    if (!made) return Unexpected(made.error());
    return {};
}

}  // namespace nezumi
