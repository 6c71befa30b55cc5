// The library `table`: every count is checked before the work begins, and every loop can be stopped.
#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/sort.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi::library {
namespace {

bool has_metamethod(lua_State* lua, int metatable, const char* name) {
    lua_pushstring(lua, name);
    const bool has = lua_rawget(lua, metatable) != LUA_TNIL;
    lua_pop(lua, 1);
    return has;
}

lua_Integer check_length(lua_State* lua, int index, unsigned access) {
    check_table(lua, index, access | has_length);
    return luaL_len(lua, index);
}

int insert(lua_State* lua) {
    const auto after = static_cast<lua_Integer>(static_cast<lua_Unsigned>(check_length(lua, 1, reads | writes)) + 1);
    switch (lua_gettop(lua)) {
        case 2: lua_seti(lua, 1, after); return 0;
        case 3: {
            const lua_Integer position = luaL_checkinteger(lua, 2);
            luaL_argcheck(lua, static_cast<lua_Unsigned>(position) - 1u < static_cast<lua_Unsigned>(after), 2,
                          "position out of bounds");
            luaL_argcheck(lua, after - position <= count_limit, 2, "too many elements to move");
            for (lua_Integer i = after; i > position; --i) {
                poll_budget(lua);
                lua_geti(lua, 1, i - 1);
                lua_seti(lua, 1, i);
            }
            lua_seti(lua, 1, position);
            return 0;
        }
        default: return luaL_error(lua, "wrong number of arguments to 'insert'");
    }
}

int remove(lua_State* lua) {
    const lua_Integer length = check_length(lua, 1, reads | writes);
    lua_Integer position = luaL_optinteger(lua, 2, length);
    if (position != length) {
        luaL_argcheck(lua, static_cast<lua_Unsigned>(position) - 1u <= static_cast<lua_Unsigned>(length), 2,
                      "position out of bounds");
    }
    luaL_argcheck(lua, length - position <= count_limit, 2, "too many elements to move");
    lua_geti(lua, 1, position);
    for (; position < length; ++position) {
        poll_budget(lua);
        lua_geti(lua, 1, position + 1);
        lua_seti(lua, 1, position);
    }
    lua_pushnil(lua);
    lua_seti(lua, 1, position);
    return 1;
}

int move(lua_State* lua) {
    const lua_Integer first = luaL_checkinteger(lua, 2);
    const lua_Integer last = luaL_checkinteger(lua, 3);
    const lua_Integer to = luaL_checkinteger(lua, 4);
    const int target = lua_isnoneornil(lua, 5) ? 1 : 5;
    check_table(lua, 1, reads);
    check_table(lua, target, writes);
    lua_pushvalue(lua, target);
    if (last < first) return 1;
    const lua_Unsigned distance = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first);
    luaL_argcheck(lua, distance < static_cast<lua_Unsigned>(count_limit), 3, "too many elements to move");
    const auto count = static_cast<lua_Integer>(distance) + 1;
    luaL_argcheck(lua, to <= LUA_MAXINTEGER - count + 1, 4, "destination wrap around");
    const bool upwards = to > last || to <= first || (target != 1 && lua_compare(lua, 1, target, LUA_OPEQ) == 0);
    for (lua_Integer step = 0; step < count; ++step) {
        poll_budget(lua);
        const lua_Integer i = upwards ? step : count - 1 - step;
        lua_geti(lua, 1, first + i);
        lua_seti(lua, target, to + i);
    }
    return 1;
}

int concatenate(lua_State* lua) {
    lua_Integer last = check_length(lua, 1, reads);
    std::size_t gap = 0;
    const char* separator = luaL_optlstring(lua, 2, "", &gap);
    const lua_Integer first = luaL_optinteger(lua, 3, 1);
    last = luaL_optinteger(lua, 4, last);
    if (first <= last) {
        luaL_argcheck(
            lua,
            static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first) < static_cast<lua_Unsigned>(count_limit),
            1, "too many elements to concatenate");
    }
    luaL_Buffer buffer;
    luaL_buffinit(lua, &buffer);
    for (lua_Integer i = first; i <= last; ++i) {
        poll_budget(lua);
        lua_geti(lua, 1, i);
        if (lua_isstring(lua, -1) == 0) {
            return luaL_error(lua, "invalid value (at index %I) in table for 'concat'", static_cast<LUAI_UACINT>(i));
        }
        luaL_addvalue(&buffer);
        if (i == last) break;  // `last` may be the largest integer
        luaL_addlstring(&buffer, separator, gap);
    }
    luaL_pushresult(&buffer);
    return 1;
}

int unpack_table(lua_State* lua) {
    const lua_Integer first = luaL_optinteger(lua, 2, 1);
    const lua_Integer last = lua_isnoneornil(lua, 3) ? luaL_len(lua, 1) : luaL_checkinteger(lua, 3);
    if (first > last) return 0;
    const lua_Unsigned distance = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first);
    if (distance >= static_cast<lua_Unsigned>(count_limit) ||
        lua_checkstack(lua, static_cast<int>(distance) + 1) == 0) {
        return luaL_error(lua, "too many results to unpack");
    }
    const int count = static_cast<int>(distance) + 1;
    for (int i = 0; i < count; ++i) {
        poll_budget(lua);
        lua_geti(lua, 1, first + i);
    }
    return count;
}

}  // namespace

void check_table(lua_State* lua, int index, unsigned access) {
    if (lua_type(lua, index) == LUA_TTABLE) return;
    if (lua_getmetatable(lua, index) != 0) {
        const int metatable = lua_gettop(lua);
        const bool fits = ((access & reads) == 0 || has_metamethod(lua, metatable, "__index")) &&
                          ((access & writes) == 0 || has_metamethod(lua, metatable, "__newindex")) &&
                          ((access & has_length) == 0 || has_metamethod(lua, metatable, "__len"));
        lua_pop(lua, 1);
        if (fits) return;
    }
    luaL_checktype(lua, index, LUA_TTABLE);
}

const Entries& table() {
    static const Entries entries = [] {
        Entries list = stock("table", {"pack"});
        list.insert(list.end(), {{"concat", concatenate},
                                 {"insert", insert},
                                 {"move", move},
                                 {"remove", remove},
                                 {"sort", sort_table},
                                 {"unpack", unpack_table}});
        return list;
    }();
    return entries;
}

}  // namespace nezumi::library
