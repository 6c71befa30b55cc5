// What `input` and `output` return: objects that read and write one port and know its type at compile time.
#pragma once

#include <lua.hpp>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// Pushes the object of a port and remembers it in the slot. May raise a Lua error (memory).
void push_port_object(lua_State* L, PortSlot& slot);

/// "input 'in'".
std::string port_title(const PortDeclaration& declaration);

}  // namespace nezumi
