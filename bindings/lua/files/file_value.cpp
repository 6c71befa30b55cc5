// Copies values out of Lua without raising Lua errors.
#include "bindings/lua/files/file_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

constexpr int deepest = 32;
constexpr std::size_t most_parts = 1'000'000;

class ValueReader {
public:
    explicit ValueReader(lua_State* lua) : lua_(lua) {}

    Expected<Value> read(int index, int depth) {
        if (depth > deepest) return failure("tables are nested too deeply, or a table is within itself");
        if (++parts_ > most_parts) return failure(fmt::format("has more than {} values", most_parts));
        if (lua_checkstack(lua_, 4) == 0) return failure("tables are nested too deeply");
        switch (lua_type(lua_, index)) {
            case LUA_TNONE:
            case LUA_TNIL: return Value{};
            case LUA_TTABLE: return read_table(index, depth);
            case LUA_TLIGHTUSERDATA: {
                const auto number = reinterpret_cast<std::uintptr_t>(lua_touserdata(lua_, index));
                return Value{FileThing{static_cast<std::size_t>(number) - 1}};
            }
            case LUA_TFUNCTION: return Value{FileFunction{}};
            default:
                if (Value single = read_single(lua_, index); !single.is_nothing()) return single;
                return Value{FileOther{lua_typename(lua_, lua_type(lua_, index))}};
        }
    }

private:
    // Only for strings, because the conversion of a number could raise an error.
    std::string text_at(int index) {
        std::size_t size = 0;
        const char* text = lua_tolstring(lua_, index, &size);
        return {text, size};
    }

    std::string key_at(int index) {
        switch (lua_type(lua_, index)) {
            case LUA_TSTRING: return text_at(index);
            case LUA_TNUMBER:
                if (lua_isinteger(lua_, index) != 0) return fmt::format("[{}]", lua_tointeger(lua_, index));
                return fmt::format("[{}]", number_at(lua_, index));
            case LUA_TBOOLEAN: return lua_toboolean(lua_, index) != 0 ? "[true]" : "[false]";
            default: return fmt::format("[a {}]", lua_typename(lua_, lua_type(lua_, index)));
        }
    }

    Expected<Value> read_table(int index, int depth) {
        index = lua_absindex(lua_, index);
        if (push_behind_lock(lua_, index)) {
            auto behind = read_table(-1, depth);
            lua_pop(lua_, 1);
            return behind;
        }
        FileTable table;
        for (lua_Integer i = 1;; ++i) {
            const bool nothing = lua_rawgeti(lua_, index, i) == LUA_TNIL;
            if (nothing) {
                lua_pop(lua_, 1);
                break;
            }
            auto element = read(-1, depth + 1);
            lua_pop(lua_, 1);
            if (!element) return element;
            table.elements.push_back(std::move(*element));
        }
        const auto count = static_cast<lua_Integer>(table.elements.size());
        lua_pushnil(lua_);
        while (lua_next(lua_, index) != 0) {
            const bool is_element =
                lua_isinteger(lua_, -2) != 0 && lua_tointeger(lua_, -2) >= 1 && lua_tointeger(lua_, -2) <= count;
            if (!is_element) {
                std::string key = key_at(-2);
                auto value = read(-1, depth + 1);
                if (!value) {
                    lua_pop(lua_, 2);
                    return value;
                }
                table.fields.push_back({std::move(key), std::move(*value)});
            }
            lua_pop(lua_, 1);
        }
        std::stable_sort(table.fields.begin(), table.fields.end(),
                         [](const auto& a, const auto& b) { return a.name < b.name; });
        return Value{std::move(table)};
    }

    lua_State* lua_;
    std::size_t parts_ = 0;
};

// Pushes a table that contains numbers and such tables.
void push_facts(lua_State* lua, const FileTable& table) {
    const auto push = [lua](const Value& value) {
        if (const auto* inner = value.get_if<FileTable>()) {
            push_facts(lua, *inner);
        } else if (const auto* whole = value.get_if<std::int64_t>()) {
            lua_pushinteger(lua, *whole);
        } else {
            lua_pushnumber(lua, number_of(value).value_or(0));
        }
    };
    lua_createtable(lua, static_cast<int>(table.elements.size()), static_cast<int>(table.fields.size()));
    for (std::size_t i = 0; i < table.elements.size(); ++i) {
        push(table.elements[i]);
        lua_rawseti(lua, -2, static_cast<lua_Integer>(i) + 1);
    }
    for (const FileField& field : table.fields) {
        lua_pushlstring(lua, field.name.data(), field.name.size());
        push(field.value);
        lua_rawset(lua, -3);
    }
}

}  // namespace

Expected<Value> read_file_value(lua_State* lua, int index) { return ValueReader(lua).read(index, 0); }

void push_file_thing(lua_State* lua, FileThing thing, const FileTable& facts) {
    luaL_checkstack(lua, 10, nullptr);
    if (!facts.fields.empty()) push_facts(lua, facts);
    lua_pushlightuserdata(lua, reinterpret_cast<void*>(static_cast<std::uintptr_t>(thing.index + 1)));
    if (!facts.fields.empty()) lua_rawseti(lua, -2, 1);
}

}  // namespace nezumi
