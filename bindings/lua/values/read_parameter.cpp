// Reads values of parameters from Lua: single values, and arrays of one type.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

template <class T>
std::vector<T> elements(lua_State* L, int index, std::ptrdiff_t size) {
    std::vector<T> all;
    all.reserve(static_cast<std::size_t>(size));
    for (std::ptrdiff_t i = 1; i <= size; ++i) {
        lua_rawgeti(L, index, i);
        if constexpr (std::is_same_v<T, double>) {
            all.push_back(number_at(L, -1));
        } else {
            all.push_back(read_single(L, -1).get<T>());
        }
        lua_pop(L, 1);
    }
    return all;
}

Expected<Value> read_array(lua_State* L, int index) {
    Mismatch why;
    const std::ptrdiff_t size = read_array_size(L, index, &why);
    if (size < 0) return failure(describe(why));
    if (size == 0) return std::vector<double>();  // an empty array fits every type of array
    // The first element determines the type of the others; an array of integers and other numbers is an array of
    // numbers.
    int first = LUA_TNIL;
    bool all_whole = true;
    for (std::ptrdiff_t i = 1; i <= size; ++i) {
        lua_rawgeti(L, index, i);
        const int type = lua_type(L, -1);
        all_whole = all_whole && lua_isinteger(L, -1);
        lua_pop(L, 1);
        if (i == 1) first = type;
        if (type != LUA_TBOOLEAN && type != LUA_TNUMBER && type != LUA_TSTRING) {
            return failure(
                fmt::format("element {} expected a boolean, a number or a string, got {}", i, lua_typename(L, type)));
        }
        if (type != first) {
            return failure(fmt::format("element {} expected a {}, as the first one, got {}", i, lua_typename(L, first),
                                       lua_typename(L, type)));
        }
    }
    if (first == LUA_TBOOLEAN) return elements<bool>(L, index, size);
    if (first == LUA_TSTRING) return elements<std::string>(L, index, size);
    if (all_whole) return elements<std::int64_t>(L, index, size);
    return elements<double>(L, index, size);
}

}  // namespace

Value read_single(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TBOOLEAN: return lua_toboolean(L, index) != 0;
        case LUA_TNUMBER:
            if (lua_isinteger(L, index)) return static_cast<std::int64_t>(lua_tointeger(L, index));
            return number_at(L, index);
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* text = lua_tolstring(L, index, &size);
            return std::string(text, size);
        }
        default: return {};
    }
}

Expected<Value> read_parameter(lua_State* L, int index) {
    if (lua_checkstack(L, codec_stack) == 0) return failure("not enough memory");
    index = lua_absindex(L, index);
    if (lua_type(L, index) == LUA_TTABLE) return read_array(L, UnlockedTable(L, index).index());
    if (Value single = read_single(L, index); !single.is_nothing()) return single;
    return failure(
        fmt::format("expected a boolean, a number, a string or an array of them, got {}", luaL_typename(L, index)));
}

}  // namespace nezumi
