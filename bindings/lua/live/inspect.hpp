// Any value of Lua as text for people: what the console shows and its `print` prints.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>

namespace nezumi {

struct InspectOptions {
    std::size_t width = 100;  ///< [characters] of a line; a table that does not fit gets several
    int depth = 6;            ///< of tables in tables; deeper ones are {...}
    std::size_t items = 100;  ///< of each table; the rest is counted
    std::size_t text = 2000;  ///< [bytes] of each string
    bool quote = true;        ///< a string itself in quotes; those in tables always are
};

/// The value at `index`: tables as Lua writes them, their keys in the order of `pairs`, `__tostring` honoured, a table
/// within itself as <cycle>. Calls metamethods, within a budget of a tenth of a second. Raises no Lua error: what can't
/// be shown says why.
std::string inspect(lua_State* L, int index, const InspectOptions& options = {});

}  // namespace nezumi
