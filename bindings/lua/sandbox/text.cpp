// `tostring` with numbers instead of addresses.
#include "bindings/lua/sandbox/text.hpp"

#include "bindings/lua/sandbox/state.hpp"

namespace nezumi {
namespace {

const char identities_key = 0;  // its address is the key of the registry's table from value to number

// Pushes the table with the numbers of existing values.
void push_identities(lua_State* lua) {
    if (lua_rawgetp(lua, LUA_REGISTRYINDEX, &identities_key) == LUA_TTABLE) return;
    lua_pop(lua, 1);
    lua_newtable(lua);
    lua_createtable(lua, 0, 1);
    lua_pushliteral(lua, "k");
    lua_setfield(lua, -2, "__mode");
    lua_setmetatable(lua, -2);
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, &identities_key);
}

}  // namespace

void push_identity(lua_State* lua, int index) {
    index = lua_absindex(lua, index);
    const int base = lua_gettop(lua);
    luaL_checkstack(lua, 5, nullptr);
    push_identities(lua);
    lua_pushvalue(lua, index);
    if (lua_rawget(lua, base + 1) != LUA_TNUMBER) {
        lua_pushvalue(lua, index);
        lua_pushinteger(lua, LuaState::of(lua).next_identity());
        lua_copy(lua, -1, base + 2);
        lua_rawset(lua, base + 1);
    }
    const bool named = luaL_getmetafield(lua, index, "__name") == LUA_TSTRING;
    const char* type = named ? lua_tostring(lua, -1) : luaL_typename(lua, index);
    lua_pushfstring(lua, "%s: %I", type, static_cast<LUAI_UACINT>(lua_tointeger(lua, base + 2)));
    lua_replace(lua, base + 1);
    lua_settop(lua, base + 1);
}

const char* push_text(lua_State* lua, int index, std::size_t* length) {
    index = lua_absindex(lua, index);
    if (is_nan(lua, index)) return lua_pushliteral(lua, "nan"), lua_tolstring(lua, -1, length);
    switch (lua_type(lua, index)) {
        case LUA_TNIL:
        case LUA_TBOOLEAN:
        case LUA_TNUMBER:
        case LUA_TSTRING: return luaL_tolstring(lua, index, length);
        default: break;
    }
    if (luaL_callmeta(lua, index, "__tostring") == 0) {
        push_identity(lua, index);
    } else if (lua_isstring(lua, -1) == 0) {
        luaL_error(lua, "'__tostring' must return a string");
    }
    return lua_tolstring(lua, -1, length);
}

}  // namespace nezumi
