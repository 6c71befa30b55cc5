// Compares the reader of Lua's syntax with Lua itself.
#pragma once

#include <lua.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

struct CloseLua {
    void operator()(lua_State* lua) const { lua_close(lua); }
};

/// What Lua says of texts; one that it takes has "".
class LuaReference {
public:
    std::string says(std::string_view text) const {
        const int status = luaL_loadbufferx(lua_.get(), text.data(), text.size(), "=text", "t");
        std::string message = status == LUA_OK ? "" : lua_tostring(lua_.get(), -1);
        lua_settop(lua_.get(), 0);
        return message;
    }

    /// Whether the reader takes what Lua takes, and refuses what Lua refuses. What is only too much for Lua's compiler
    /// (local variables, registers, levels) is not compared.
    bool agrees(std::string_view text) const {
        const std::string message = says(text);
        for (const char* limit : {"overflow", "too many", "too long", "not enough memory"}) {
            if (message.find(limit) != std::string::npos) return true;
        }
        return message.empty() == (SyntaxTree(text).error() == nullptr);
    }

private:
    std::unique_ptr<lua_State, CloseLua> lua_{luaL_newstate()};
};

}  // namespace nezumi
