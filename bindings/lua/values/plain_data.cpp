// Visits tables breadth first without recursion, because a linked list of a million tables must not overflow the stack.
#include "bindings/lua/values/plain_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/base/names.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

// Numbers in ascending order, then strings, then false, then true: the order in which scripts see them.
bool key_before(const Value& a, const Value& b) {
    const auto group = [](const Value& v) { return v.is<std::string>() ? 1 : v.is<bool>() ? 2 : 0; };
    if (group(a) != group(b)) return group(a) < group(b);
    if (group(a) == 1) return a.get<std::string>() < b.get<std::string>();
    if (group(a) == 2) return !a.get<bool>() && b.get<bool>();
    if (a.is<std::int64_t>() && b.is<std::int64_t>()) return a.get<std::int64_t>() < b.get<std::int64_t>();
    const auto number = [](const Value& v) {
        return v.is<double>() ? v.get<double>() : static_cast<double>(v.get<std::int64_t>());
    };
    return number(a) < number(b);
}

// "[7]", "[2.5]", "[true]".
std::string bracketed(const Value& key) {
    if (const auto* number = key.get_if<double>()) return fmt::format("[{}]", *number);
    return "[" + lua_text(key) + "]";
}

std::string key_text(const Value& key) {
    const auto* text = key.get_if<std::string>();
    if (text == nullptr) return bracketed(key);
    return is_identifier(*text) ? "." + *text : fmt::format("[\"{}\"]", *text);
}

std::string type_name(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TFUNCTION: return "a function";
        case LUA_TTHREAD: return "a coroutine";
        case LUA_TUSERDATA:
            if (luaL_getmetafield(L, index, "__plain") == LUA_TNIL) return "a port or another object of the engine";
            lua_pop(L, 1);
            return "a matrix";
        default: return luaL_typename(L, index);
    }
}

// Where a value was found: under `key` of the table with index `table`, or as the value with index `value` of those to
// copy. Whole paths are not stored: for a linked list of n tables they would take memory in proportion to n^2.
struct Origin {
    std::size_t table = no_table;
    Value key;
    std::size_t value = 0;

    static constexpr std::size_t no_table = static_cast<std::size_t>(-1);
};

// Copies the values. The object exists outside of the protected call in which it works, so that a Lua error skips no
// destructor.
struct Taker {
    const std::vector<std::string>& names;
    std::vector<Dropped>& dropped;
    PlainData data;
    std::vector<Origin> origins;                           // of data.tables
    std::unordered_map<const void*, std::size_t> indices;  // in data.tables, by address of the table
    std::vector<Value> keys;                               // of the table that is being copied
    Origin origin;                                         // of the value that is being copied

    bool takes_objects = true;  // objects with plain data, such as matrices, are copied as this data

    // The number of values and the bytes of text that may still be copied.
    PlainLimit left{std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max()};
    bool too_much = false;  // the limit is exceeded
    std::size_t whole = 0;  // number of tables that were copied completely

    int work_list = 0;  // stack index of a Lua table: data.tables[i - 1] is at i

    // "state.a.b"; for a very long path only its end.
    std::string path_of(Origin at) const {
        constexpr std::size_t longest = 200;
        std::string path;
        while (at.table != Origin::no_table) {
            path.insert(0, key_text(at.key));
            if (path.size() > longest) return "..." + path;
            at = origins[at.table];
        }
        return names[at.value] + path;
    }

    // Pops the value on top of the stack and copies it. An object of the engine may be replaced by its plain data.
    Value take(lua_State* L) {
        Value value;
        if (takes_objects && lua_type(L, -1) == LUA_TUSERDATA && luaL_callmeta(L, -1, "__plain") != 0)
            lua_remove(L, -2);
        switch (lua_type(L, -1)) {
            case LUA_TNIL: break;
            case LUA_TTABLE: value = take_table(L); break;
            default:
                if (!scalar(L, -1, value)) dropped.push_back({path_of(origin), type_name(L, -1)});
        }
        lua_pop(L, 1);
        return value;
    }

    bool scalar(lua_State* L, int index, Value& out) {
        if (lua_type(L, index) == LUA_TSTRING) {
            const std::size_t size = lua_rawlen(L, index);
            too_much = too_much || size > left.text;
            if (too_much) return true;
            left.text -= size;
        }
        out = read_single(L, index);
        return !out.is_nothing();
    }

    // A reference to the table on top of the stack; a new table is added to the work list.
    Value take_table(lua_State* L) {
        const auto [known, is_new] = indices.try_emplace(lua_topointer(L, -1), data.tables.size());
        if (!is_new) return TableRef{known->second};
        data.tables.emplace_back();
        origins.push_back(origin);
        lua_pushvalue(L, -1);
        lua_rawseti(L, work_list, static_cast<lua_Integer>(data.tables.size()));
        return TableRef{data.tables.size() - 1};
    }

    void take_fields(lua_State* L, std::size_t index) {
        lua_rawgeti(L, work_list, static_cast<lua_Integer>(index + 1));
        // The array of a parameter is locked, but its elements are plain data.
        if (push_behind_lock(L, lua_gettop(L))) {
            lua_remove(L, -2);
        } else if (!has_hidden_metatable(L, -1) && lua_getmetatable(L, -1) != 0) {
            dropped.push_back({path_of(origins[index]), "a table with a metatable"});
            lua_pop(L, 1);
        }
        const int table = lua_gettop(L);
        keys.clear();
        bool bad_key = false;
        lua_pushnil(L);
        while (lua_next(L, table) != 0) {
            lua_pop(L, 1);
            too_much = too_much || keys.size() >= left.values;
            if (too_much) break;
            Value key;
            if (scalar(L, -1, key)) {
                keys.push_back(std::move(key));
            } else {
                bad_key = true;
            }
        }
        if (bad_key)
            dropped.push_back({path_of(origins[index]), "a table with a key that is a table, a function or an object"});
        left.values -= keys.size();
        // Lists are in order as they come.
        if (!std::is_sorted(keys.begin(), keys.end(), key_before)) std::sort(keys.begin(), keys.end(), key_before);
        for (Value& key : keys) {
            if (too_much) break;
            detail::push_any(L, key);
            lua_rawget(L, table);
            origin = {.table = index, .key = key};
            Value value = take(L);
            if (!value.is_nothing()) data.tables[index].push_back({std::move(key), std::move(value)});
        }
        lua_settop(L, table - 1);
    }

    // Stack: this, values...
    static int run(lua_State* L) {
        Taker& self = *static_cast<Taker*>(lua_touserdata(L, 1));
        const int count = lua_gettop(L) - 1;
        luaL_checkstack(L, 10, nullptr);
        lua_newtable(L);
        self.work_list = lua_gettop(L);
        for (int i = 0; i < count; ++i) {
            self.origin = {.value = static_cast<std::size_t>(i)};
            lua_pushvalue(L, i + 2);
            self.data.values.push_back(self.take(L));
        }
        for (; self.whole < self.data.tables.size(); ++self.whole) {
            self.take_fields(L, self.whole);
            if (self.too_much) return 0;
        }
        return 0;
    }
};

// Copies the topmost `count` values.
Expected<void> run(Taker& taker, lua_State* L, int count, Budget budget) {
    const int first = lua_gettop(L) - count + 1;
    if (lua_checkstack(L, count + 4) == 0) return failure("not enough memory");
    lua_pushcfunction(L, Taker::run);
    lua_pushlightuserdata(L, &taker);
    for (int i = 0; i < count; ++i) lua_pushvalue(L, first + i);
    if (auto ok = protected_call(L, count + 1, 0, budget); !ok) return Unexpected(ok.error());
    return {};
}

constexpr const char* left_out = "left out: too large to show";

int refuse_access(lua_State* L) {
    return luaL_error(L,
                      "this table was left out, so that no tick is late: at most %d values are read at once; a command "
                      "of the script can return a part",
                      static_cast<int>(PlainLimit{}.values));
}

int say_left_out(lua_State* L) { return lua_pushfstring(L, "(%s)", left_out), 1; }

// Not a table, because an empty table would be misleading.
void push_left_out(lua_State* L) {
    lua_newuserdatauv(L, 0, 0);
    if (luaL_newmetatable(L, left_out) != 0) {
        for (const char* event : {"__index", "__newindex", "__len", "__pairs"}) {
            lua_pushcfunction(L, refuse_access);
            lua_setfield(L, -2, event);
        }
        lua_pushcfunction(L, say_left_out);
        lua_setfield(L, -2, "__tostring");
        lua_pushboolean(L, 0);
        lua_setfield(L, -2, "__metatable");
    }
    lua_setmetatable(L, -2);
}

void push(lua_State* L, const PlainData& data, std::size_t whole) {
    luaL_checkstack(L, static_cast<int>(data.values.size()) + 8, nullptr);
    const auto push_value = [&](const Value& value, int tables) {
        if (const auto* ref = value.get_if<TableRef>()) {
            lua_rawgeti(L, tables, static_cast<lua_Integer>(ref->index + 1));
        } else {
            detail::push_any(L, value);
        }
    };
    lua_createtable(L, static_cast<int>(data.tables.size()), 0);
    const int tables = lua_gettop(L);
    for (std::size_t i = 0; i < data.tables.size(); ++i) {
        if (i < whole) {
            lua_newtable(L);
        } else {
            push_left_out(L);
        }
        lua_rawseti(L, tables, static_cast<lua_Integer>(i + 1));
    }
    for (std::size_t i = 0; i < std::min(whole, data.tables.size()); ++i) {
        lua_rawgeti(L, tables, static_cast<lua_Integer>(i + 1));
        for (const auto& [key, value] : data.tables[i]) {
            push_value(key, tables);
            push_value(value, tables);
            lua_rawset(L, -3);
        }
        lua_pop(L, 1);
    }
    for (const Value& value : data.values) push_value(value, tables);
    lua_remove(L, tables);
}

}  // namespace

Expected<PlainData> take_plain(lua_State* L, int count, Budget budget, const std::vector<std::string>& names,
                               std::vector<Dropped>& dropped, const PlainLimit& limit) {
    Taker taker{.names = names,
                .dropped = dropped,
                .data = {},
                .origins = {},
                .indices = {},
                .keys = {},
                .origin = {},
                .left = limit};
    if (auto ok = run(taker, L, count, budget); !ok) return Unexpected(ok.error());
    if (taker.too_much)
        return failure(
            fmt::format("a copy can have at most {} values and {} MB of text", limit.values, limit.text >> 20U));
    return std::move(taker.data);
}

Expected<PlainSnapshot> snapshot_plain(lua_State* L, Budget budget, const PlainLimit& limit, const std::string& name,
                                       std::vector<Dropped>* dropped) {
    const std::vector<std::string> names{name};
    std::vector<Dropped> unseen;
    Taker taker{.names = names,
                .dropped = dropped != nullptr ? *dropped : unseen,
                .data = {},
                .origins = {},
                .indices = {},
                .keys = {},
                .origin = {},
                .takes_objects = dropped == nullptr,
                .left = limit};
    if (auto ok = run(taker, L, 1, budget); !ok) return Unexpected(ok.error());
    // Empties tables that were copied only in part, because that part would differ from run to run.
    for (std::size_t i = taker.whole; i < taker.data.tables.size(); ++i) taker.data.tables[i].clear();
    return PlainSnapshot{std::move(taker.data), taker.whole};
}

void visit_plain(const PlainData& data, const LeafVisitor& visit) {
    constexpr int deepest = 16;
    int entries_left = 5000;
    const auto visit_table = [&](const auto& self, std::size_t table, const LeafPath& path, int depth) -> void {
        for (const PlainData::Entry& entry : data.tables[table]) {
            if (--entries_left < 0) return;
            const Value &key = entry[0], &value = entry[1];
            const auto* text = key.get_if<std::string>();
            const std::string name = text != nullptr ? *text : bracketed(key);
            const LeafPath at = path.field(name);
            if (const auto* within = value.get_if<TableRef>()) {
                if (depth < deepest) self(self, within->index, at, depth + 1);
            } else {
                visit_leaves(value, visit, at);
            }
        }
    };
    if (data.values.empty()) return;
    if (const auto* first = data.values.front().get_if<TableRef>())
        visit_table(visit_table, first->index, LeafPath{}, 1);
}

void push_plain(lua_State* L, const PlainData& data) { push(L, data, data.tables.size()); }

void push_plain(lua_State* L, const PlainSnapshot& snapshot) { push(L, snapshot.data, snapshot.whole); }

}  // namespace nezumi
