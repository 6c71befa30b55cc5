// Messages about wrong arguments, and the conversion of a stored error to a Lua error.
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/sandbox/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nezumi {
namespace {

// What a script should use instead of a parameter that callbacks of other robot systems have.
std::string_view in_place_of(std::string_view parameter) {
    constexpr std::string_view clocks[] = {"now", "t", "time", "seconds"};
    if (parameter == "dt") return "`dt` is a global";
    if (std::find(std::begin(clocks), std::end(clocks), parameter) != std::end(clocks)) return "`now()` is the time";
    return "leave it out";
}

}  // namespace

std::string_view Arguments::kind(int position) const {
    return has(position) ? luaL_typename(lua, index(position)) : "nothing";
}

Expected<std::string> Arguments::text(int position, std::string_view what) const {
    if (lua_type(lua, index(position)) != LUA_TSTRING)
        return failure(fmt::format("expected {}, got {}", what, kind(position)));
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, index(position), &length);
    return std::string(text, length);
}

Expected<double> Arguments::number(int position, std::string_view what) const {
    if (lua_type(lua, index(position)) != LUA_TNUMBER)
        return failure(fmt::format("expected {}, got {}", what, kind(position)));
    return number_at(lua, index(position));
}

Expected<void> Arguments::at_most(std::string_view function, int most, std::string_view usage) const {
    if (count() <= most) return {};
    const std::string expected =
        most == 0 ? "no arguments" : fmt::format("at most {} argument{}", most, most == 1 ? "" : "s");
    return failure(fmt::format("{0}: expected {1}, got {2}: {0}{3}", function, expected, count(), usage));
}

int raise_kept(lua_State* L) {
    luaL_checkstack(L, 3, nullptr);
    luaL_where(L, 1);
    const std::string& text = LuaState::of(L).kept_error;
    lua_pushlstring(L, text.data(), text.size());
    lua_concat(L, 2);
    return lua_error(L);
}

int raise_kept_alone(lua_State* L) {
    const std::string& text = LuaState::of(L).kept_error;
    lua_pushlstring(L, text.data(), text.size());
    return lua_error(L);
}

Expected<void> check_parameters(lua_State* L, int index, int given) {
    if (lua_type(L, index) != LUA_TFUNCTION || lua_iscfunction(L, index) != 0) return {};
    lua_Debug function;
    lua_pushvalue(L, index);
    lua_getinfo(L, ">u", &function);
    if (function.nparams <= given) return {};
    lua_pushvalue(L, index);
    const char* found = lua_getlocal(L, nullptr, given + 1);
    const std::string name = found != nullptr ? found : "?";
    lua_pop(L, 1);
    return failure(fmt::format("its parameter '{}' is never given: {}", name, in_place_of(name)));
}

}  // namespace nezumi
