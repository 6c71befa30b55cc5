// Copies the arguments that a Lua file passes to a word (a function such as `robot` or `arena`) out of Lua.
#pragma once

#include <lua.hpp>

#include "engine/base/error.hpp"
#include "engine/records/file_table.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// The value at `index`, or nothing for nil. Runs no metamethods and raises no Lua error. Nested tables may be 32
/// levels deep, so a table that contains itself is an error. More than 1 000 000 parts are an error.
Expected<Value> read_file_value(lua_State* lua, int index);

/// Pushes an object of the arena; `read_file_value` converts it back. If there are facts, pushes a table that has the
/// facts as fields and the object as element 1. May raise a Lua error (memory).
void push_file_thing(lua_State* lua, FileThing thing, const FileTable& facts);

}  // namespace nezumi
