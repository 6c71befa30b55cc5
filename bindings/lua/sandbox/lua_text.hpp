// Where Lua's own machine code lies, to tell whether a signal has interrupted it.
#pragma once

namespace nezumi {

/// Finds out where the code of the Lua library lies; once, before the first signal.
void find_lua_text();

/// Whether the code that a signal has interrupted is Lua's: not that of the memory allocator or any other library that
/// Lua calls, nor ours. `context` is the third argument of the signal's handler. False where that can't be known, as
/// when Lua is linked into the program itself. Safe in a signal handler.
bool was_in_lua(const void* context);

}  // namespace nezumi
