// The list of native modules.
#include "bindings/lua/modules/native_modules.hpp"

#include "bindings/lua/modules/matrix.hpp"
#include "bindings/lua/sandbox/text.hpp"

namespace nezumi {

bool push_native_module(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TSTRING || string_at(L, index) != "native.matrix") return false;
    push_matrix_module(L);
    return true;
}

}  // namespace nezumi
