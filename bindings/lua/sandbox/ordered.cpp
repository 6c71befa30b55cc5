// Sorts the keys for `pairs` and `next`.
#include "bindings/lua/sandbox/ordered.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi {
namespace {

enum class KeyKind : unsigned char { integer, real, text, boolean };

// A key of a table as a C++ value. `text` is valid as long as the table has this key.
struct Key {
    union {
        lua_Integer integer;  // 0 or 1 for a boolean
        lua_Number real;
        const char* text;
    };
    std::size_t length;
    KeyKind kind;
};

constexpr std::size_t keys_on_c_stack = 32;

Key read_key(lua_State* lua, int index) {
    Key key{};
    switch (lua_type(lua, index)) {
        case LUA_TNUMBER:
            if (lua_isinteger(lua, index) != 0) {
                key.integer = lua_tointeger(lua, index);
                key.kind = KeyKind::integer;
            } else {
                key.real = lua_tonumber(lua, index);
                key.kind = KeyKind::real;
            }
            break;
        case LUA_TSTRING:
            key.text = lua_tolstring(lua, index, &key.length);
            key.kind = KeyKind::text;
            break;
        case LUA_TBOOLEAN:
            key.integer = lua_toboolean(lua, index);
            key.kind = KeyKind::boolean;
            break;
        default:
            // The text does not depend on the key, because which one is found first differs from run to run.
            luaL_error(lua,
                       "a table with a table or function as a key can't be traversed: use numbers, strings or booleans"
                       " as keys");
    }
    return key;
}

void push_key(lua_State* lua, const Key& key) {
    switch (key.kind) {
        case KeyKind::integer: return lua_pushinteger(lua, key.integer);
        case KeyKind::real: return lua_pushnumber(lua, key.real);
        case KeyKind::text: lua_pushlstring(lua, key.text, key.length); return;
        case KeyKind::boolean: return lua_pushboolean(lua, static_cast<int>(key.integer));
    }
}

// A real key is never a whole number: Lua converts those to integers.
bool less_than(lua_Integer a, lua_Number b) {
    if (b >= 0x1p63) return true;
    if (b < -0x1p63) return false;
    return a < static_cast<lua_Integer>(b) || (a == static_cast<lua_Integer>(b) && b > 0);
}

int group(KeyKind kind) { return kind == KeyKind::integer ? static_cast<int>(KeyKind::real) : static_cast<int>(kind); }

bool operator<(const Key& a, const Key& b) {
    if (a.kind != b.kind) {
        if (a.kind == KeyKind::integer && b.kind == KeyKind::real) return less_than(a.integer, b.real);
        if (a.kind == KeyKind::real && b.kind == KeyKind::integer) return !less_than(b.integer, a.real);
        return group(a.kind) < group(b.kind);
    }
    switch (a.kind) {
        case KeyKind::real: return a.real < b.real;
        case KeyKind::text: return std::string_view(a.text, a.length) < std::string_view(b.text, b.length);
        default: return a.integer < b.integer;
    }
}

bool in_sequence(const Key& key, lua_Integer length) {
    return key.kind == KeyKind::integer && key.integer >= 1 && key.integer <= length;
}

// Pushes a sorted array of the keys of the table at `table` that are not in 1..length; nothing if there are none.
bool push_sorted_keys(lua_State* lua, int table, lua_Integer length) {
    luaL_checkstack(lua, 5, nullptr);
    Key few[keys_on_c_stack];
    Key* keys = few;
    std::size_t count = 0;
    for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) {
        poll_budget(lua);
        const Key key = read_key(lua, -2);
        if (in_sequence(key, length)) continue;
        if (count < keys_on_c_stack) few[count] = key;
        ++count;
    }
    if (count == 0) return false;
    lua_pushnil(lua);
    if (count > keys_on_c_stack) {
        keys = static_cast<Key*>(lua_newuserdatauv(lua, count * sizeof(Key), 0));
        lua_replace(lua, -2);
        Key* next = keys;
        for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1)) {
            const Key key = read_key(lua, -2);
            if (!in_sequence(key, length)) *next++ = key;
        }
    }
    std::sort(keys, keys + count);
    lua_createtable(lua, static_cast<int>(count), 0);
    for (std::size_t at = 0; at < count; ++at) {
        push_key(lua, keys[at]);
        lua_rawseti(lua, -2, static_cast<lua_Integer>(at + 1));
    }
    lua_remove(lua, -2);
    return true;
}

// Pushes key and value of the next existing entry, from index `at` of the sorted keys on. Returns its index, or 0 with
// nothing pushed.
lua_Integer push_entry(lua_State* lua, int table, int keys, lua_Integer at) {
    for (;; ++at) {
        poll_budget(lua);
        if (lua_rawgeti(lua, keys, at) == LUA_TNIL) break;
        lua_pushvalue(lua, -1);
        if (lua_rawget(lua, table) != LUA_TNIL) return at;
        lua_pop(lua, 2);
    }
    lua_pop(lua, 1);
    return 0;
}

bool push_element(lua_State* lua, int table, lua_Integer position) {
    lua_pushinteger(lua, position);
    if (lua_rawgeti(lua, table, position) != LUA_TNIL) return true;
    lua_pop(lua, 2);
    return false;
}

// The iterator of `pairs`. Upvalues: the table; the sorted other keys, nil while 1..n is traversed; the index of the
// last visited one of them.
int step(lua_State* lua) {
    constexpr int table = lua_upvalueindex(1);
    constexpr int keys = lua_upvalueindex(2);
    constexpr int place = lua_upvalueindex(3);
    const bool starts = lua_isnoneornil(lua, 2);
    if (starts || lua_type(lua, keys) == LUA_TNIL) {
        const lua_Integer last = starts ? 0 : lua_tointeger(lua, 2);
        if (starts) {
            lua_pushnil(lua);
            lua_replace(lua, keys);
        }
        if (push_element(lua, table, last + 1)) return 2;
        lua_pushvalue(lua, table);
        if (!push_sorted_keys(lua, lua_gettop(lua), last)) {
            lua_pushnil(lua);
            return 1;
        }
        lua_replace(lua, keys);
        lua_pushinteger(lua, 0);
        lua_replace(lua, place);
    }
    const lua_Integer at = push_entry(lua, table, keys, lua_tointeger(lua, place) + 1);
    if (at == 0) {
        lua_pushnil(lua);
        return 1;
    }
    lua_pushinteger(lua, at);
    lua_replace(lua, place);
    return 2;
}

int after_pairs_metamethod(lua_State*, int, lua_KContext) { return 3; }

const char cache_key = 0;  // its address is the key of the registry's table that maps tables to sorted keys, for `next`

// Pushes the sorted keys that `next` made for the table at `table`, or nil. Creates the cache if `make`.
int push_cached_keys(lua_State* lua, int table, bool make) {
    if (!make && !LuaState::of(lua).has_next_cache) {
        lua_pushnil(lua);
        return LUA_TNIL;
    }
    if (lua_rawgetp(lua, LUA_REGISTRYINDEX, &cache_key) != LUA_TTABLE) {
        if (!make) return LUA_TNIL;
        lua_pop(lua, 1);
        lua_newtable(lua);
        lua_createtable(lua, 0, 1);
        lua_pushliteral(lua, "k");
        lua_setfield(lua, -2, "__mode");
        lua_setmetatable(lua, -2);
        lua_pushvalue(lua, -1);
        lua_rawsetp(lua, LUA_REGISTRYINDEX, &cache_key);
        LuaState::of(lua).has_next_cache = true;
    }
    lua_pushvalue(lua, table);
    const int type = lua_rawget(lua, -2);
    lua_remove(lua, -2);
    return type;
}

// Stores the keys on top of the stack for the table, and pops them.
void cache_keys(lua_State* lua, int table) {
    push_cached_keys(lua, table, true);
    lua_pop(lua, 1);
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &cache_key);
    lua_pushvalue(lua, table);
    lua_rotate(lua, -3, -1);
    lua_rawset(lua, -3);
    lua_pop(lua, 1);
}

// The index of the first of the sorted keys on top of the stack that is greater than `key`.
lua_Integer place_after(lua_State* lua, const Key& key) {
    lua_Integer low = 1;
    auto high = static_cast<lua_Integer>(lua_rawlen(lua, -1)) + 1;
    while (low < high) {
        const lua_Integer middle = low + (high - low) / 2;
        lua_rawgeti(lua, -1, middle);
        if (key < read_key(lua, -1)) {
            high = middle;
        } else {
            low = middle + 1;
        }
        lua_pop(lua, 1);
    }
    return low;
}

int first_entry(lua_State* lua) {
    if (push_cached_keys(lua, 1, false) != LUA_TNIL) {
        lua_pushnil(lua);
        cache_keys(lua, 1);
    }
    if (push_element(lua, 1, 1)) return 2;
    lua_settop(lua, 1);
    lua_pushnil(lua);
    if (lua_next(lua, 1) == 0) {
        lua_pushnil(lua);
        return 1;
    }
    lua_pushnil(lua);
    lua_replace(lua, 3);
    Key least = read_key(lua, 2);  // slot 2 keeps it alive
    lua_pushvalue(lua, 2);
    while (lua_next(lua, 1) != 0) {
        poll_budget(lua);
        lua_pop(lua, 1);
        const Key key = read_key(lua, -1);
        if (!(key < least)) continue;
        least = key;
        lua_copy(lua, -1, 2);
    }
    lua_settop(lua, 2);
    if (least.kind == KeyKind::integer && least.integer > 1) {
        lua_pushboolean(lua, 1);  // the next call must not take the key for one in 1..n
        cache_keys(lua, 1);
    }
    lua_pushvalue(lua, 2);
    lua_rawget(lua, 1);
    return 2;
}

lua_Integer sequence_length(lua_State* lua, int table) {
    lua_Integer length = 0;
    while (push_element(lua, table, length + 1)) {
        poll_budget(lua);
        lua_pop(lua, 2);
        ++length;
    }
    return length;
}

}  // namespace

int ordered_pairs(lua_State* lua) {
    if (luaL_getmetafield(lua, 1, "__pairs") != LUA_TNIL) {
        lua_pushvalue(lua, 1);
        lua_callk(lua, 1, 3, 0, after_pairs_metamethod);
        return 3;
    }
    luaL_checktype(lua, 1, LUA_TTABLE);
    if (!push_behind_lock(lua, 1)) lua_pushvalue(lua, 1);
    lua_pushnil(lua);
    lua_pushnil(lua);
    lua_pushcclosure(lua, step, 3);
    lua_pushvalue(lua, 1);
    lua_pushnil(lua);
    return 3;
}

int ordered_next(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    lua_settop(lua, 2);
    if (push_behind_lock(lua, 1)) lua_replace(lua, 1);
    if (lua_isnil(lua, 2)) return first_entry(lua);

    const Key key = read_key(lua, 2);
    const int cached = push_cached_keys(lua, 1, false);
    const bool may_be_in_sequence = key.kind == KeyKind::integer && key.integer >= 1;
    lua_Integer at = 1;
    if (cached == LUA_TTABLE) {
        at = place_after(lua, key);
        if (may_be_in_sequence) {  // `key` may still be in 1..n, if the table is traversed twice at a time
            lua_rawgeti(lua, -1, at - 1);
            const bool in_others = lua_rawequal(lua, 2, -1) != 0;
            lua_pop(lua, 1);
            if (!in_others) at = 1;
            if (!in_others && push_element(lua, 1, key.integer + 1)) return 2;
        }
    } else {
        const bool in_sequence = may_be_in_sequence && cached == LUA_TNIL;
        if (in_sequence && push_element(lua, 1, key.integer + 1)) return 2;
        lua_pop(lua, 1);
        if (!push_sorted_keys(lua, 1, in_sequence ? key.integer : sequence_length(lua, 1))) {
            lua_pushnil(lua);
            return 1;
        }
        if (!in_sequence) at = place_after(lua, key);
        lua_pushvalue(lua, -1);
        cache_keys(lua, 1);
    }
    if (push_entry(lua, 1, lua_gettop(lua), at) != 0) return 2;
    lua_pushnil(lua);
    cache_keys(lua, 1);
    lua_pushnil(lua);
    return 1;
}

}  // namespace nezumi
