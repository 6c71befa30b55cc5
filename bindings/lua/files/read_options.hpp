// Reads a table of options in a call from Lua, by the description of its structure.
#pragma once

#include <lua.hpp>

#include "bindings/lua/files/file_value.hpp"
#include "engine/records/read_record.hpp"

namespace nezumi {

/// Reads the table at `index`; no value is an empty table. `by_hand(fields)` reads fields that descriptions can't read.
/// Raises no Lua error.
template <Recorded T, class ByHand>
Expected<void> read_options(lua_State* lua, int index, FieldCheck check, T& out, Reading reading, ByHand by_hand) {
    const auto value = read_file_value(lua, index);
    if (!value) {
        check.wrong_at({}, check.noun() + "s: " + value.error().message);
        return check.result();
    }
    Fields fields(check, *value);
    by_hand(fields);
    read_record(fields, out, reading);
    fields.done();
    return check.result();
}

template <Recorded T>
Expected<void> read_options(lua_State* lua, int index, FieldCheck check, T& out, Reading reading = {}) {
    return read_options(lua, index, std::move(check), out, reading, [](Fields&) {});
}

}  // namespace nezumi
