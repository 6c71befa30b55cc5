// A sandbox for tests: runs a text and tells what came of it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"

namespace nezumi {

class Box {
public:
    explicit Box(StateOptions options = {}) {
        options.print = [this](std::string_view line) { printed.emplace_back(line); };
        state = std::move(create_sandbox(std::move(options)).value());
    }

    lua_State* lua() const { return state->lua(); }

    /// What the text returns, its values as text with blanks between, or "file:line: message".
    std::string run(std::string_view text, Budget budget = Budget{10.0}) {
        const auto returned = try_run(text, budget);
        return returned ? *returned : describe(returned.error());
    }

    /// The same, with its error.
    Expected<std::string> try_run(std::string_view text, Budget budget = Budget{10.0}) {
        over_budget = false;
        lua_settop(lua(), 0);
        const auto chunk = compile(text, "box.lua");
        if (!chunk) return Unexpected(chunk.error());
        if (const auto loaded = load_chunk(lua(), *chunk); !loaded) return Unexpected(loaded.error());
        return try_call(budget);
    }

    /// The same within 0.1 s, for what does not end by itself.
    std::string run_for_a_moment(std::string_view text) { return run(text, paced_budget); }

    /// Calls the function that lies alone on the stack.
    std::string call(Budget budget = Budget{10.0}) {
        const auto returned = try_call(budget);
        return returned ? *returned : describe(returned.error());
    }

    Expected<std::string> try_call(Budget budget) {
        const auto called = protected_call(lua(), 0, LUA_MULTRET, budget);
        if (!called) {
            over_budget = called.error().over_budget;
            return Unexpected(called.error());
        }
        std::string shown;
        for (int i = 1; i <= lua_gettop(lua()); ++i) {
            if (i > 1) shown += ' ';
            shown += text_of(i);
        }
        return shown;
    }

    std::unique_ptr<LuaState> state;
    std::vector<std::string> printed;
    bool over_budget = false;

private:
    std::string text_of(int index) {
        switch (lua_type(lua(), index)) {
            case LUA_TNIL: return "nil";
            case LUA_TBOOLEAN: return lua_toboolean(lua(), index) != 0 ? "true" : "false";
            case LUA_TSTRING:
            case LUA_TNUMBER: {
                lua_pushvalue(lua(), index);
                std::size_t length = 0;
                const char* text = lua_tolstring(lua(), -1, &length);
                std::string copy(text, length);
                lua_pop(lua(), 1);
                return copy;
            }
            default: return luaL_typename(lua(), index);
        }
    }
};

}  // namespace nezumi
