// One value of plain data on Lua's stack.
#pragma once

#include <cstdint>
#include <lua.hpp>
#include <string>
#include <variant>

#include "engine/components/plain_data.hpp"

namespace nezumi {

/// Pushes a value that is no table; nil for one that is. May raise a Lua error (memory).
inline void push_scalar(lua_State* L, const PlainData::Value& value) {
    if (const auto* truth = std::get_if<bool>(&value)) {
        lua_pushboolean(L, *truth ? 1 : 0);
    } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        lua_pushinteger(L, *whole);
    } else if (const auto* number = std::get_if<double>(&value)) {
        lua_pushnumber(L, *number);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
        lua_pushlstring(L, text->data(), text->size());
    } else {
        lua_pushnil(L);
    }
}

}  // namespace nezumi
