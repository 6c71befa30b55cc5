// The condition of a breakpoint: a Lua function from the console, copied into a separate Lua state, so that it can't
// change the run.
#pragma once

#include <lua.hpp>
#include <memory>
#include <vector>

#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

class BreakCondition {
public:
    /// Copies the function at `index`. It may use its argument, the library, and local variables of the console whose
    /// values are numbers, texts or booleans. Raises no error.
    static Expected<std::unique_ptr<BreakCondition>> of_function(lua_State* lua, int index);

    /// Calls the function with a table of the variables. Returns an error if the function fails.
    Expected<bool> holds(const std::vector<ErrorFrames::Variable>& variables);

private:
    explicit BreakCondition(std::unique_ptr<LuaState> state) : state_(std::move(state)) {}
    std::unique_ptr<LuaState> state_;
};

}  // namespace nezumi
