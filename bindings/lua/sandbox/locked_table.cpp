// An empty table with a metatable that reads elsewhere and refuses to write.
#include "bindings/lua/sandbox/locked_table.hpp"

#include "bindings/lua/sandbox/text.hpp"

namespace nezumi {
namespace {

// Its address is the key of the table behind in the metatable: no script can have such a key.
constexpr char kBehind = 0;

// Upvalues: what the table is called, and why it can't be changed.
int refuse_write(lua_State* lua) {
    const char* name = lua_tostring(lua, lua_upvalueindex(1));
    const char* why = lua_tostring(lua, lua_upvalueindex(2));
    const char* key = push_text(lua, 2);
    if (lua_type(lua, 2) == LUA_TNUMBER) return luaL_error(lua, "can't set '%s[%s]': '%s' %s", name, key, name, why);
    return luaL_error(lua, "can't set '%s.%s': '%s' %s", name, key, name, why);
}

int length_behind(lua_State* lua) {
    lua_settop(lua, 1);
    if (push_behind_lock(lua, 1)) lua_len(lua, -1);
    return 1;
}

}  // namespace

void lock_table(lua_State* lua, const char* name, const char* why) {
    luaL_checkstack(lua, 6, nullptr);
    lua_newtable(lua);
    lua_createtable(lua, 0, 5);
    lua_rotate(lua, -3, 2);  // the locked table, its metatable, what is behind it
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, -3, &kBehind);
    lua_setfield(lua, -2, "__index");
    lua_pushstring(lua, name);
    lua_pushstring(lua, why);
    lua_pushcclosure(lua, refuse_write, 2);
    lua_setfield(lua, -2, "__newindex");
    lua_pushcfunction(lua, length_behind);
    lua_setfield(lua, -2, "__len");
    lua_pushboolean(lua, 0);
    lua_setfield(lua, -2, "__metatable");
    lua_setmetatable(lua, -2);
}

bool push_behind_lock(lua_State* lua, int index) {
    if (lua_getmetatable(lua, index) == 0) return false;
    const bool locked = lua_rawgetp(lua, -1, &kBehind) != LUA_TNIL;
    if (locked) {
        lua_remove(lua, -2);
    } else {
        lua_pop(lua, 2);
    }
    return locked;
}

}  // namespace nezumi
