// A bottom-up merge sort of indices; the elements stay where they are.
#include "bindings/lua/sandbox/sort.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi::library {
namespace {

using Place = std::uint32_t;

// Sorts `places` stably by `less(a, b)`, which may return anything and may raise a Lua error.
template <class Less>
const Place* merge_sort(lua_State* lua, Place* places, Place* other, std::size_t count, Less less) {
    for (std::size_t width = 1; width < count; width *= 2) {
        for (std::size_t begin = 0; begin < count; begin += 2 * width) {
            poll_budget(lua);
            const std::size_t middle = begin + width < count ? begin + width : count;
            const std::size_t end = middle + width < count ? middle + width : count;
            std::size_t left = begin;
            std::size_t right = middle;
            // A sorted run takes only one comparison.
            if (middle == end || !less(places[middle], places[middle - 1])) {
                std::memcpy(other + begin, places + begin, (end - begin) * sizeof(Place));
                continue;
            }
            for (std::size_t at = begin; at < end; ++at) {
                const bool take_right = left == middle || (right < end && less(places[right], places[left]));
                other[at] = places[take_right ? right++ : left++];
            }
        }
        std::swap(places, other);
    }
    return places;
}

// A number or a text as a C++ value, for comparing without calling Lua.
union Plain {
    lua_Number number;
    struct {
        const char* start;
        std::size_t length;
    } text;
};

// Stack indices of `sort_table`; 3 is the memory for the indices.
constexpr int sorted_table = 1;
constexpr int comparison = 2;
constexpr int elements = 4;
constexpr int plain_memory = 5;

// Larger integers are not exact as floats, so Lua itself compares them.
constexpr lua_Integer exact_integers = lua_Integer{1} << 53;

bool fits_plain(lua_State* lua, int type) {
    if (type == LUA_TSTRING || (type == LUA_TNUMBER && lua_isinteger(lua, -1) == 0)) return true;
    if (type != LUA_TNUMBER) return false;
    const lua_Integer number = lua_tointeger(lua, -1);
    return -exact_integers <= number && number <= exact_integers;
}

// Fills `plain` if all elements are numbers or all are strings, and returns this type; otherwise returns LUA_TNONE.
int read_plain(lua_State* lua, Plain* plain, std::size_t count) {
    int all = LUA_TNONE;
    for (std::size_t i = 0; i < count; ++i) {
        const int type = lua_rawgeti(lua, elements, static_cast<lua_Integer>(i + 1));
        if (i == 0) all = type;
        if (type != all || !fits_plain(lua, type)) return LUA_TNONE;
        if (type == LUA_TNUMBER) {
            plain[i].number = lua_tonumber(lua, -1);
        } else {
            plain[i].text.start = lua_tolstring(lua, -1, &plain[i].text.length);
        }
        lua_pop(lua, 1);
    }
    return all;
}

const Place* sort_by_lua(lua_State* lua, Place* places, std::size_t count) {
    const bool has_comparison = !lua_isnil(lua, comparison);
    return merge_sort(lua, places, places + count, count, [lua, has_comparison](Place a, Place b) {
        poll_budget(lua);
        if (has_comparison) lua_pushvalue(lua, comparison);
        lua_rawgeti(lua, elements, lua_Integer{a} + 1);
        lua_rawgeti(lua, elements, lua_Integer{b} + 1);
        bool less = false;
        if (has_comparison) {
            lua_call(lua, 2, 1);
            less = lua_toboolean(lua, -1) != 0;
            lua_pop(lua, 1);
        } else {
            less = lua_compare(lua, -2, -1, LUA_OPLT) != 0;
            lua_pop(lua, 2);
        }
        return less;
    });
}

const Place* sort_by_value(lua_State* lua, Place* places, std::size_t count) {
    auto* memory = static_cast<Plain*>(lua_newuserdatauv(lua, count * sizeof(Plain), 0));
    const int type = read_plain(lua, memory, count);
    const Plain* plain = memory;
    lua_settop(lua, plain_memory);
    if (type == LUA_TNUMBER) {
        return merge_sort(lua, places, places + count, count,
                          [plain](Place a, Place b) { return plain[a].number < plain[b].number; });
    }
    if (type == LUA_TSTRING) {
        return merge_sort(lua, places, places + count, count, [plain](Place a, Place b) {
            return std::string_view(plain[a].text.start, plain[a].text.length) <
                   std::string_view(plain[b].text.start, plain[b].text.length);
        });
    }
    return sort_by_lua(lua, places, count);
}

}  // namespace

int sort_table(lua_State* lua) {
    check_table(lua, sorted_table, reads | writes | has_length);
    const lua_Integer length = luaL_len(lua, sorted_table);
    if (length < 2) return 0;
    luaL_argcheck(lua, length <= count_limit, 1, "array too big");
    if (!lua_isnoneornil(lua, comparison)) luaL_checktype(lua, comparison, LUA_TFUNCTION);
    lua_settop(lua, comparison);
    const auto count = static_cast<std::size_t>(length);
    auto* places = static_cast<Place*>(lua_newuserdatauv(lua, 2 * count * sizeof(Place), 0));
    lua_createtable(lua, static_cast<int>(length), 0);
    for (std::size_t i = 0; i < count; ++i) {
        poll_budget(lua);
        places[i] = static_cast<Place>(i);
        lua_geti(lua, sorted_table, static_cast<lua_Integer>(i + 1));
        lua_rawseti(lua, elements, static_cast<lua_Integer>(i + 1));
    }
    const Place* sorted =
        lua_isnil(lua, comparison) ? sort_by_value(lua, places, count) : sort_by_lua(lua, places, count);
    for (std::size_t i = 0; i < count; ++i) {
        poll_budget(lua);
        lua_rawgeti(lua, elements, lua_Integer{sorted[i]} + 1);
        lua_seti(lua, sorted_table, static_cast<lua_Integer>(i + 1));
    }
    return 0;
}

}  // namespace nezumi::library
