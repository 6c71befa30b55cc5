// A call into Lua that runs in slices, so that what is typed at a console makes no tick late.
#pragma once

#include <chrono>
#include <lua.hpp>
#include <memory>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/state.hpp"

namespace nezumi {

/// One call that is taken further by `advance`, as a coroutine that yields by itself when its slice is over, also
/// through pcall and the script's own coroutines. Where Lua can't yield (in a metamethod that C calls, a comparison of
/// table.sort) it goes on until it can. The state may be used for other calls between two slices.
class SlicedCall {
public:
    enum class Progress : unsigned char { running, finished, failed };

    /// Takes the function and its `arguments` from the top of the state's main stack. `total` is what it may use in
    /// all.
    static tl::expected<std::unique_ptr<SlicedCall>, CallError> start(LuaState& state, int arguments, Budget total);
    ~SlicedCall();
    SlicedCall(const SlicedCall&) = delete;
    SlicedCall& operator=(const SlicedCall&) = delete;

    /// Runs for about `slice` of real time, or to the end. Only while running.
    Progress advance(std::chrono::microseconds slice);

    /// Where the results are once it has finished: all there is on this stack.
    lua_State* results() const { return thread_; }
    /// Why it failed.
    const CallError& error() const { return error_; }
    /// CPU time used so far [s].
    double used_seconds() const { return static_cast<double>(used_) * 1e-9; }

private:
    SlicedCall(LuaState& state, Budget total) : state_(state), total_(total) {}

    LuaState& state_;
    Budget total_;
    lua_State* thread_ = nullptr;
    int anchor_ = LUA_NOREF;  // keeps the coroutine from being collected
    int arguments_ = 0;
    std::int64_t used_ = 0;  // [ns]
    CallError error_{};
};

}  // namespace nezumi
