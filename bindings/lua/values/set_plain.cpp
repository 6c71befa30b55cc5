// Sets the tables in the order in which they were copied, so each table exists before its content is set.
#include "bindings/lua/values/set_plain.hpp"

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/values/codec.hpp"
#include "bindings/lua/values/plain_data.hpp"

namespace nezumi {
namespace {

// Stack indices of Lua tables.
struct Places {
    int tables;  // data.tables[i] is at i + 1
    int used;    // its keys are those of these tables that the script had already
};

// Whether the value on top of the stack is a table that can be reused. A locked table does not belong to the script.
bool is_own_table(lua_State* L) {
    if (lua_type(L, -1) != LUA_TTABLE) return false;
    const bool is_locked = push_behind_lock(L, -1);
    if (is_locked) lua_pop(L, 1);
    return !is_locked;
}

// Removes the plain data from the table at `from`. Puts the removed tables into the table at `into`, under the same
// keys, so that they can be reused.
void move_plain(lua_State* L, int from, int into) {
    lua_pushnil(L);
    while (lua_next(L, from) != 0) {
        const int type = lua_type(L, -1);
        if (is_scalar(lua_type(L, -2)) && (type == LUA_TTABLE || is_scalar(type))) {
            if (is_own_table(L)) {
                lua_pushvalue(L, -2);
                lua_pushvalue(L, -2);
                lua_rawset(L, into);
            }
            lua_pushvalue(L, -2);
            lua_pushnil(L);
            lua_rawset(L, from);
        }
        lua_pop(L, 1);
    }
}

// Pops a key, and pushes the script's table that `before` has for this key, or a new table if there is none or it is
// used already.
void push_table(lua_State* L, int before, const Places& places) {
    lua_rawget(L, before);
    const bool is_there = lua_istable(L, -1);
    if (is_there) {
        lua_pushvalue(L, -1);
        lua_rawget(L, places.used);
    }
    if (!is_there || lua_toboolean(L, -1) != 0) {
        lua_settop(L, before);
        lua_newtable(L);
        return;
    }
    lua_pop(L, 1);
    lua_pushvalue(L, -1);
    lua_pushboolean(L, 1);
    lua_rawset(L, places.used);
}

void set_field(lua_State* L, int table, int before, const Value& key, const Value& value, const Places& places) {
    detail::push_any(L, key);
    lua_rawget(L, table);
    const bool is_other = !lua_isnil(L, -1);  // the script's value is not plain data, and stays
    lua_pop(L, 1);
    if (is_other) return;
    if (const auto* ref = value.get_if<TableRef>()) {
        const auto place = static_cast<lua_Integer>(ref->index + 1);
        if (lua_rawgeti(L, places.tables, place) == LUA_TNIL) {
            lua_pop(L, 1);
            detail::push_any(L, key);
            push_table(L, before, places);
            lua_pushvalue(L, -1);
            lua_rawseti(L, places.tables, place);
        }
    } else {
        detail::push_any(L, value);
    }
    detail::push_any(L, key);
    lua_insert(L, -2);
    lua_rawset(L, table);
}

}  // namespace

void set_plain(lua_State* L, const PlainData& data) {
    const auto* first = data.values.empty() ? nullptr : data.values.front().get_if<TableRef>();
    if (first == nullptr) return;
    luaL_checkstack(L, 12, nullptr);
    const int root = lua_gettop(L);
    lua_newtable(L);
    lua_newtable(L);
    const Places places{root + 1, root + 2};
    lua_pushvalue(L, root);
    lua_rawseti(L, places.tables, static_cast<lua_Integer>(first->index + 1));
    lua_pushvalue(L, root);
    lua_pushboolean(L, 1);
    lua_rawset(L, places.used);
    for (std::size_t i = 0; i < data.tables.size(); ++i) {
        lua_rawgeti(L, places.tables, static_cast<lua_Integer>(i + 1));
        if (lua_istable(L, -1)) {
            const int table = lua_gettop(L);
            lua_newtable(L);
            move_plain(L, table, table + 1);
            for (const auto& [key, value] : data.tables[i]) set_field(L, table, table + 1, key, value, places);
        }
        lua_settop(L, places.used);
    }
    lua_settop(L, root);
}

}  // namespace nezumi
