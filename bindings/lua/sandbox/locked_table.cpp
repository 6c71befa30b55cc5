// A locked table is empty: its metatable reads from another table, the table behind it, and refuses assignments. A
// locked copy contains the table behind it under a hidden key, so all copies can share one metatable.
#include "bindings/lua/sandbox/locked_table.hpp"

#include "bindings/lua/sandbox/text.hpp"

namespace nezumi {
namespace {

// The addresses of these variables are keys that no script can have: for the table behind (in the metatable, or in a
// copy), for the owner and the key of a copy, and for the metatable of copies (in the registry).
constexpr char table_behind = 0, copy_owner = 0, copy_key = 0, copies_metatable = 0;
// The address of this is the key that marks a hidden metatable.
constexpr char hidden_mark = 0;

// Upvalues: the name of the table, and why it can't be changed.
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

// Upvalue: the C function for a missing name.
int read_behind(lua_State* lua) {
    lua_settop(lua, 2);
    lua_rawgetp(lua, 1, &table_behind);
    lua_pushvalue(lua, 2);
    if (lua_rawget(lua, 3) != LUA_TNIL || lua_type(lua, 2) != LUA_TSTRING) return 1;
    return lua_tocfunction(lua, lua_upvalueindex(1))(lua);
}

}  // namespace

void lock_table(lua_State* lua, const char* name, const char* why) {
    luaL_checkstack(lua, 6, nullptr);
    lua_newtable(lua);
    lua_createtable(lua, 0, 5);
    lua_rotate(lua, -3, 2);  // the read-only table, its metatable, the table behind
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, -3, &table_behind);
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

void open_copies(lua_State* lua, lua_CFunction refuse, lua_CFunction missing) {
    luaL_checkstack(lua, 3, nullptr);
    lua_createtable(lua, 0, 5);
    lua_pushboolean(lua, 1);  // not a table: the copy itself has the table behind
    lua_rawsetp(lua, -2, &table_behind);
    lua_pushcfunction(lua, missing);
    lua_pushcclosure(lua, read_behind, 1);
    lua_setfield(lua, -2, "__index");
    lua_pushcfunction(lua, refuse);
    lua_setfield(lua, -2, "__newindex");
    lua_pushcfunction(lua, length_behind);
    lua_setfield(lua, -2, "__len");
    lua_pushboolean(lua, 0);
    lua_setfield(lua, -2, "__metatable");
    lua_rawsetp(lua, LUA_REGISTRYINDEX, &copies_metatable);
}

void lock_copy(lua_State* lua, int owner, int key) {
    luaL_checkstack(lua, 3, nullptr);
    lua_createtable(lua, 0, 3);
    lua_insert(lua, -2);
    lua_rawsetp(lua, -2, &table_behind);
    lua_pushvalue(lua, owner);
    lua_rawsetp(lua, -2, &copy_owner);
    lua_pushvalue(lua, key);
    lua_rawsetp(lua, -2, &copy_key);
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &copies_metatable);
    lua_setmetatable(lua, -2);
}

bool push_origin(lua_State* lua, int index) {
    index = lua_absindex(lua, index);
    if (!push_behind_lock(lua, index)) return false;
    lua_pop(lua, 1);
    if (lua_rawgetp(lua, index, &copy_owner) == LUA_TNIL) return lua_pop(lua, 1), false;
    lua_rawgetp(lua, index, &copy_key);
    return true;
}

bool push_behind_lock(lua_State* lua, int index) {
    if (lua_getmetatable(lua, index) == 0) return false;
    const int type = lua_rawgetp(lua, -1, &table_behind);
    if (type == LUA_TTABLE) return lua_remove(lua, -2), true;
    lua_pop(lua, 2);
    if (type == LUA_TNIL) return false;
    lua_rawgetp(lua, index, &table_behind);
    return true;
}

void hide_metatable(lua_State* lua) {
    lua_pushboolean(lua, 1);
    lua_rawsetp(lua, -2, &hidden_mark);
}

bool has_hidden_metatable(lua_State* lua, int index) {
    if (lua_getmetatable(lua, index) == 0) return false;
    const bool hidden = lua_rawgetp(lua, -1, &hidden_mark) != LUA_TNIL;
    lua_pop(lua, 2);
    return hidden;
}

}  // namespace nezumi
