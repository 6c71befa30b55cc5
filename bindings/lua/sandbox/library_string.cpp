// The `string` library. Its pattern functions (find, match, gsub) are in library_patterns.cpp.
#include <cstring>

#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/library_patterns.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/text.hpp"

namespace nezumi::library {
namespace {

constexpr std::size_t longest_layout = 10000;  // [bytes]: Lua reads a format without checking the time limit

int repeat(lua_State* lua) {
    std::size_t length = 0;
    std::size_t gap = 0;
    const char* text = luaL_checklstring(lua, 1, &length);
    const lua_Integer count = luaL_checkinteger(lua, 2);
    const char* separator = luaL_optlstring(lua, 3, "", &gap);
    const std::size_t piece = length + gap;
    // Repeating an empty text very often is refused as well, as a mistake.
    const std::size_t most = LuaState::of(lua).memory_limit() / (piece > 0 ? piece : 1);
    if (count > 0 && static_cast<std::size_t>(count) > most) return luaL_error(lua, "resulting string too large");
    if (count <= 0 || piece == 0) {
        lua_pushliteral(lua, "");
        return 1;
    }
    const std::size_t total = piece * static_cast<std::size_t>(count) - gap;
    luaL_Buffer buffer;
    char* start = luaL_buffinitsize(lua, &buffer, total);
    std::memcpy(start, text, length);
    std::size_t filled = length;
    if (filled < total) {
        std::memcpy(start + filled, separator, gap);
        filled += gap;
        while (filled < total) {  // each round doubles the text, so there are few rounds
            const std::size_t more = filled < total - filled ? filled : total - filled;
            std::memcpy(start + filled, start, more);
            filled += more;
        }
    }
    luaL_pushresultsize(&buffer, total);
    return 1;
}

// Finds the next conversion of a format, such as `%5d`: returns the place of its letter, or null if there is none.
const char* next_conversion(const char* at, const char* end) {
    while (at < end) {
        if (*at++ != '%') continue;
        at += std::strspn(at, "-+ #0123456789.");
        if (at >= end) return nullptr;  // Lua's own function reports the error
        if (*at != '%') return at;
        ++at;
    }
    return nullptr;
}

// Replaces the value of a %p by a text for %s.
void replace_pointer(lua_State* lua, int argument) {
    switch (lua_type(lua, argument)) {
        case LUA_TNIL:
        case LUA_TBOOLEAN:
        case LUA_TNUMBER: lua_pushliteral(lua, "(null)"); break;
        default: push_identity(lua, argument);
    }
    lua_replace(lua, argument);
}

// Lua's own `format`, with texts instead of addresses.
int format(lua_State* lua) {
    static const lua_CFunction stock_format = stock("string", "format");
    std::size_t length = 0;
    const char* layout = luaL_checklstring(lua, 1, &length);
    const int count = lua_gettop(lua);
    bool has_pointer = false;
    int argument = 1;
    for (const char* at = layout; (at = next_conversion(at, layout + length)) != nullptr; ++at) {
        if (++argument > count) break;
        if (*at == 's' && lua_type(lua, argument) != LUA_TSTRING) {
            push_text(lua, argument);
            lua_replace(lua, argument);
        } else if (*at == 'p') {
            replace_pointer(lua, argument);
            has_pointer = true;
        } else if (is_nan(lua, argument)) {
            lua_pushnumber(lua, number_at(lua, argument));
            lua_replace(lua, argument);
        }
    }
    if (has_pointer) {
        luaL_Buffer buffer;
        char* copy = luaL_buffinitsize(lua, &buffer, length);
        std::memcpy(copy, layout, length);
        for (const char* at = layout; (at = next_conversion(at, layout + length)) != nullptr; ++at) {
            if (*at == 'p') copy[at - layout] = 's';
        }
        luaL_pushresultsize(&buffer, length);
        lua_replace(lua, 1);
    }
    return stock_format(lua);
}

void check_layout(lua_State* lua) {
    std::size_t length = 0;
    luaL_checklstring(lua, 1, &length);
    luaL_argcheck(lua, length <= longest_layout, 1, "format too long");
}

int pack(lua_State* lua) {
    static const lua_CFunction stock_pack = stock("string", "pack");
    check_layout(lua);
    return stock_pack(lua);
}

int pack_size(lua_State* lua) {
    static const lua_CFunction stock_pack_size = stock("string", "packsize");
    check_layout(lua);
    return stock_pack_size(lua);
}

int unpack_string(lua_State* lua) {
    static const lua_CFunction stock_unpack = stock("string", "unpack");
    check_layout(lua);
    return stock_unpack(lua);
}

}  // namespace

const Entries& string() {
    static const Entries entries = [] {
        Entries list = stock("string", {"byte", "char", "len", "lower", "reverse", "sub", "upper"});
        list.insert(list.end(), {{"find", find_pattern},
                                 {"format", format},
                                 {"gmatch", match_all},
                                 {"gsub", substitute},
                                 {"match", match_pattern},
                                 {"pack", pack},
                                 {"packsize", pack_size},
                                 {"rep", repeat},
                                 {"unpack", unpack_string}});
        return list;
    }();
    return entries;
}

const Entries& string_metamethods() {
    static const Entries entries =
        stock("string metatable", {"__add", "__div", "__idiv", "__mod", "__mul", "__pow", "__sub", "__unm"});
    return entries;
}

}  // namespace nezumi::library
