// Any value of Lua as text for people: what the console shows, and what `print` and `log` say.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>

namespace nezumi {

/// How much is looked at and said, so that showing a value never takes longer than a moment, however large it is. What
/// several calls share they use up together.
struct InspectWork {
    std::size_t steps = 2000;                    ///< entries of tables
    std::size_t bytes = std::size_t{64} * 1024;  ///< of text
};

struct InspectOptions {
    std::size_t width = 100;      ///< [characters] of a line; a table that does not fit gets several
    int depth = 6;                ///< of tables in tables; deeper ones are {...}
    std::size_t items = 100;      ///< of each table; the rest is "..."
    std::size_t text = 2000;      ///< [bytes] of each string
    bool quote = true;            ///< a string itself in quotes; those in tables always are
    InspectWork* work = nullptr;  ///< shared with other calls; null: of this call alone
};

/// The value at `index`: tables as Lua writes them, their keys in the order of `pairs`, `__tostring` honoured, a table
/// within itself as <cycle>. Of a table with more entries than may be looked at, what it has from 1 on is shown. Calls
/// metamethods, within a budget of 10 ms. Raises no Lua error: what can't be shown says why.
std::string inspect(lua_State* L, int index, const InspectOptions& options = {});

/// Pushes what `print` and `log` say of all values on the stack: tables as above, everything else as `tostring` gives
/// it, tabs between. Runs within the call that prints, in its time: the same in every run. May raise a Lua error.
void push_line(lua_State* L);

}  // namespace nezumi
