// Converts any Lua value to readable text, for the console, `print` and `log`.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>

namespace nezumi {

/// Limits for the work and for the text, so that showing a value is always fast. Several calls may share them.
struct InspectWork {
    std::size_t steps = 2000;                    ///< entries of tables
    std::size_t bytes = std::size_t{64} * 1024;  ///< of text
};

struct InspectOptions {
    std::size_t width = 100;      ///< [characters] of a line; a table that does not fit gets several
    int depth = 6;                ///< depth of nested tables; deeper ones are {...}
    std::size_t items = 100;      ///< of each table; the rest is "..."
    std::size_t text = 2000;      ///< [bytes] of each string
    bool quote = true;            ///< quotes around a string itself; strings in tables always have quotes
    InspectWork* work = nullptr;  ///< shared with other calls; null: only for this call
};

/// The value at `index`: tables in Lua syntax, keys in the order of `pairs`, with `__tostring`, a table within itself
/// as <cycle>. If a table has too many entries, only its elements from 1 on are shown. Calls metamethods within a time
/// limit of 10 ms. Raises no Lua error: for a value that can't be shown, the text is the reason.
std::string inspect(lua_State* L, int index, const InspectOptions& options = {});

/// Pushes the text of `print` and `log` for all values on the stack: tables as in `inspect`, other values as in
/// `tostring`, with tabs between. This has no time limit except that of the call that prints, so the text is the same
/// in every run. May raise a Lua error.
void push_line(lua_State* L);

}  // namespace nezumi
