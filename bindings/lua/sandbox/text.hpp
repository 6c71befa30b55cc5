// Converts values to text, without the addresses that Lua would show.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <lua.hpp>
#include <string_view>

namespace nezumi {

/// Pushes the text of the value at `index`, as `tostring` gives it, and returns it. Supports `__tostring` and `__name`.
/// The text of a table, function, userdata or coroutine has a number, such as "table: 1", in the order in which the
/// state first needed such texts. So equal texts mean the same value, and texts are the same in every run. May raise a
/// Lua error.
const char* push_text(lua_State* lua, int index, std::size_t* length = nullptr);

/// Pushes the text for the identity of the value at `index` ("table: 1"), without `__tostring`.
void push_identity(lua_State* lua, int index);

/// Whether the value at `index` is the number NaN.
inline bool is_nan(lua_State* lua, int index) {
    return lua_type(lua, index) == LUA_TNUMBER && std::isnan(lua_tonumber(lua, index));
}

/// The number at `index`. A NaN is returned without a sign, because processors give NaNs different signs.
inline double number_at(lua_State* lua, int index) {
    const double number = lua_tonumber(lua, index);
    return std::isnan(number) ? std::numeric_limits<double>::quiet_NaN() : number;
}

/// The whole string at `index`, which may contain zero bytes. Valid as long as the value.
inline std::string_view string_at(lua_State* lua, int index) {
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, index, &length);
    return {text, length};
}

}  // namespace nezumi
