// Finds the location of a call in a script.
#include "bindings/lua/script/script_call.hpp"

namespace nezumi {

Place caller(lua_State* L) {
    lua_Debug activation;
    if (lua_getstack(L, 1, &activation) == 0 || lua_getinfo(L, "Sl", &activation) == 0 || activation.currentline <= 0)
        return {};
    const char* file = *activation.source == '@' ? activation.source + 1 : activation.short_src;
    return {file, activation.currentline};
}

int keep_function(lua_State* L) {
    if (lua_type(L, 2) != LUA_TFUNCTION || lua_gettop(L) > 3) return LUA_NOREF;
    lua_pushvalue(L, 2);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

bool keep_diagnostic(lua_State* L, Script& script, const Error& error) {
    constexpr std::size_t most = 1000;
    std::vector<Error>* diagnostics = script.context().diagnostics;
    if (diagnostics == nullptr || script.phase() != Script::Phase::loading || diagnostics->size() >= most) return false;
    // Errors in a message's file have their own location.
    diagnostics->push_back(error.place.file.empty() ? Error{error.message, caller(L)} : error);
    return true;
}

}  // namespace nezumi
