// The basic functions, without those that could catch the end of a time limit or break the sandbox.
#include "bindings/lua/sandbox/error_frames.hpp"
#include "bindings/lua/sandbox/inspect.hpp"
#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/ordered.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi::library {
namespace {

// The results of a protected call: true and the results, or false and the error. `below` values are under the results.
int finish_protected(lua_State* lua, int status, lua_KContext below) {
    if (status == LUA_OK || status == LUA_YIELD) return lua_gettop(lua) - static_cast<int>(below);
    poll_budget(lua);  // a script can't catch the end of its time
    forget_inner_error();
    lua_pushboolean(lua, 0);
    lua_pushvalue(lua, -2);
    return 2;
}

int pcall(lua_State* lua) {
    luaL_checkany(lua, 1);
    lua_pushboolean(lua, 1);
    lua_insert(lua, 1);
    return finish_protected(lua, lua_pcallk(lua, lua_gettop(lua) - 2, LUA_MULTRET, 0, 0, finish_protected), 0);
}

// Calls the script's handler (upvalue), but not after the end of the time limit: then it would run inside the hook,
// where it could not be stopped.
int guard_handler(lua_State* lua) {
    if (current_call->expired != 0) return 1;
    lua_settop(lua, 1);
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, 1, 1);
    return 1;
}

int xpcall(lua_State* lua) {
    const int arguments = lua_gettop(lua) - 2;
    luaL_checktype(lua, 2, LUA_TFUNCTION);
    lua_pushvalue(lua, 2);
    lua_pushcclosure(lua, guard_handler, 1);
    lua_replace(lua, 2);
    lua_pushboolean(lua, 1);
    lua_pushvalue(lua, 1);
    lua_rotate(lua, 3, 2);
    return finish_protected(lua, lua_pcallk(lua, arguments, LUA_MULTRET, 2, 2, finish_protected), 2);
}

void refuse_field(lua_State* lua, const char* field, const char* reason) {
    lua_pushstring(lua, field);
    if (lua_rawget(lua, 2) != LUA_TNIL) luaL_error(lua, "setmetatable: '%s' is refused: %s", field, reason);
    lua_pop(lua, 1);
}

// If `__call` is not a function, Lua searches the `__call` of that value in turn. A circle of such values would never
// end.
void refuse_caller(lua_State* lua) {
    lua_pushliteral(lua, "__call");
    const int type = lua_rawget(lua, 2);
    if (type != LUA_TNIL && type != LUA_TFUNCTION)
        luaL_error(lua, "setmetatable: '__call' expected a function, got %s", lua_typename(lua, type));
    lua_pop(lua, 1);
}

int get_metatable(lua_State* lua) {
    luaL_checkany(lua, 1);
    if (has_hidden_metatable(lua, 1) || lua_getmetatable(lua, 1) == 0) {
        lua_pushnil(lua);
    } else {
        luaL_getmetafield(lua, 1, "__metatable");
    }
    return 1;
}

int set_metatable(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    const int type = lua_type(lua, 2);
    luaL_argexpected(lua, type == LUA_TNIL || type == LUA_TTABLE, 2, "nil or table");
    if (luaL_getmetafield(lua, 1, "__metatable") != LUA_TNIL)
        return luaL_error(lua, "cannot change a protected metatable");
    lua_settop(lua, 2);
    if (type == LUA_TTABLE) {
        refuse_field(lua, "__gc", "a finalizer that never ends could not be stopped");
        refuse_field(lua, "__mode", "the contents of a weak table would differ from run to run");
        refuse_caller(lua);
    }
    lua_setmetatable(lua, 1);
    return 1;
}

template <int (*get)(lua_State*, int, lua_Integer)>
int next_element(lua_State* lua) {
    int is_integer = 0;
    lua_Integer last = lua_tointegerx(lua, 2, &is_integer);
    if (is_integer == 0) last = luaL_checkinteger(lua, 2);  // raises the error
    const auto next = static_cast<lua_Integer>(static_cast<lua_Unsigned>(last) + 1);
    lua_pushinteger(lua, next);
    return get(lua, 1, next) == LUA_TNIL ? 1 : 2;
}

int ipairs(lua_State* lua) {
    luaL_checkany(lua, 1);
    if (lua_type(lua, 1) != LUA_TTABLE) {
        const bool has_elements = lua_type(lua, 1) > LUA_TNIL && luaL_getmetafield(lua, 1, "__index") != LUA_TNIL;
        if (!has_elements) luaL_checktype(lua, 1, LUA_TTABLE);
        lua_settop(lua, 1);
    }
    lua_pushcfunction(lua, has_hidden_metatable(lua, 1) ? next_element<lua_rawgeti> : next_element<lua_geti>);
    lua_pushvalue(lua, 1);
    lua_pushinteger(lua, 0);
    return 3;
}

int raw_set(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    luaL_checkany(lua, 2);
    luaL_checkany(lua, 3);
    lua_settop(lua, 3);
    if (push_behind_lock(lua, 1)) return luaL_error(lua, "rawset: the table is read-only");
    lua_rawset(lua, 1);
    return 1;
}

int raw_get(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    luaL_checkany(lua, 2);
    lua_settop(lua, 2);
    if (push_behind_lock(lua, 1)) lua_replace(lua, 1);
    lua_rawget(lua, 1);
    return 1;
}

int raw_length(lua_State* lua) {
    const int type = lua_type(lua, 1);
    luaL_argexpected(lua, type == LUA_TTABLE || type == LUA_TSTRING, 1, "table or string");
    if (type == LUA_TTABLE && push_behind_lock(lua, 1)) lua_replace(lua, 1);
    lua_pushinteger(lua, static_cast<lua_Integer>(lua_rawlen(lua, 1)));
    return 1;
}

int to_text(lua_State* lua) {
    luaL_checkany(lua, 1);
    push_text(lua, 1);
    return 1;
}

int print(lua_State* lua) {
    push_line(lua);
    LuaState::of(lua).print(string_at(lua, -1));
    return 0;
}

}  // namespace

const Entries& basic() {
    static const Entries entries = [] {
        Entries list = stock("", {"assert", "error", "rawequal", "select", "tonumber", "type"});
        list.insert(list.end(), {{"getmetatable", get_metatable},
                                 {"ipairs", ipairs},
                                 {"next", ordered_next},
                                 {"pairs", ordered_pairs},
                                 {"pcall", pcall},
                                 {"print", print},
                                 {"rawget", raw_get},
                                 {"rawlen", raw_length},
                                 {"rawset", raw_set},
                                 {"setmetatable", set_metatable},
                                 {"tostring", to_text},
                                 {"xpcall", xpcall}});
        return list;
    }();
    return entries;
}

}  // namespace nezumi::library
