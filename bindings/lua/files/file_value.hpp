// Copies values out of Lua that a file passes to one of its words.
#pragma once

#include <lua.hpp>

#include "engine/base/error.hpp"
#include "engine/records/file_table.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// The value at `index`, or nothing for nil. Runs no metamethods and raises no Lua error. Nested tables may be 32
/// levels deep, so a table that contains itself is an error. A value may have 1 000 000 parts.
Expected<Value> read_file_value(lua_State* lua, int index);

/// Pushes an object of the arena; `read_file_value` gives its number again. With facts it is a table of them, whose
/// first element is the object. May raise a Lua error for want of memory.
void push_file_thing(lua_State* lua, FileThing thing, const FileTable& facts);

}  // namespace nezumi
