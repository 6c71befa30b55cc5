// Values as text, without the addresses that Lua would show.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string_view>

namespace nezumi {

/// Pushes the text of the value at `index`, as `tostring` gives it, and returns it. `__tostring` and `__name` are
/// honoured. A table, function, userdata or coroutine is "table: 1", numbered in the order in which the state first
/// asked for its text, so that equal texts mean the same value, in every run. May raise a Lua error.
const char* push_text(lua_State* lua, int index, std::size_t* length = nullptr);

/// Pushes the text of the identity of the value at `index` ("table: 1"), `__tostring` not asked.
void push_identity(lua_State* lua, int index);

/// The string at `index`, all of it: Lua's may hold zero bytes. As long as that value lives.
inline std::string_view string_at(lua_State* lua, int index) {
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, index, &length);
    return {text, length};
}

}  // namespace nezumi
