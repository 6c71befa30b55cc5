// The mark is a field of the metatable, with a key that scripts can't have.
#include "bindings/lua/sandbox/hidden_metatable.hpp"

namespace nezumi {
namespace {

constexpr char hidden_mark = 0;  // its address is the key

}  // namespace

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
