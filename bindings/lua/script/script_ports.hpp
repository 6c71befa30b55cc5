// The objects that `input` and `output` return: each reads or writes one port.
#pragma once

#include <lua.hpp>

#include "bindings/lua/script/script.hpp"

namespace nezumi {

/// Pushes the object of a port and stores it in the slot. May raise a Lua error (memory).
void push_port_object(lua_State* L, PortSlot& slot);

/// "input 'in'".
std::string port_title(const PortDeclaration& declaration);

}  // namespace nezumi
