// Tells whether a signal has interrupted Lua's own machine code.
#pragma once

namespace nezumi {

/// Finds the address range of the Lua library; once, before the first signal.
void find_lua_text();

/// Whether the interrupted code belongs to Lua, and not to the memory allocator, another library, or this program.
/// `context` is the third argument of the signal handler. False if this is unknown, for example if Lua is linked
/// statically. Safe in a signal handler.
bool was_in_lua(const void* context);

}  // namespace nezumi
