// Ends a call into Lua that runs for too long: the record of the call, and the timer that looks at it.
//
// A count hook slows Lua down whatever its interval, so none is set while a call is in time. Entering a call links a
// record into its thread, which costs a few nanoseconds; a timer on the thread's CPU time interrupts the thread every
// few milliseconds, and its signal handler sees how long the record has been there. Only when that exceeds the budget
// does the handler set a hook on the coroutine that runs, and again at each interruption until the call has returned:
// what a script catches on the way (pcall, coroutines, __close) is raised again.
#pragma once

#include <atomic>
#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <lua.hpp>

#include "engine/components/budget.hpp"

namespace nezumi {

class LuaState;

/// Steps that the pattern functions may take in one call into Lua.
inline constexpr std::int64_t pattern_step_budget = 5'000'000;

/// One call into Lua, on the C++ stack of the thread that makes it. Made by `protected_call` only.
class CallRecord {
public:
    /// `thread`: the coroutine in which it will run.
    CallRecord(lua_State* thread, Budget budget);
    ~CallRecord();
    CallRecord(const CallRecord&) = delete;
    CallRecord& operator=(const CallRecord&) = delete;

    /// A place in a script, in plain memory: it is filled where nothing may fail.
    struct ScriptPlace {
        int line = 0;    ///< 0: not known
        char file[256];  ///< set when `line` is
        void set(const lua_Debug& activation);
    };

    lua_State* const base;                   ///< the coroutine that the call was given: to the script it is none
    lua_State* volatile running;             ///< the coroutine that runs: the one to interrupt
    CallRecord* const outer;                 ///< the call within which this one was made
    volatile std::sig_atomic_t expired = 0;  ///< the budget, or that of a call around this one, is used up
    volatile std::int64_t seen = 0;          ///< [ns] of CPU time, when the timer first found this call
    std::int64_t next_hook = 0;              ///< [ns] when the timer may set the hook again
    std::int64_t budget_ns;                  ///< so long after that, the budget is used up
    const std::atomic<bool>* const stop;     ///< when this is set, the budget is used up at once; may be null
    std::int64_t expired_at = 0;             ///< [ns] when the timer found it used up
    int looks_since_expiry = 0;              ///< how often the timer has found it used up
    double budget_seconds;                   ///< for the message
    std::int64_t pattern_steps = pattern_step_budget;
    const char* stack_base;  ///< where the C stack was at the thread's outermost call

    /// The way out of Lua's own code, where no hook runs: set by the thread's outermost call, while `can_escape`.
    std::jmp_buf escape;
    volatile bool can_escape = false;

    lua_State* slice = nullptr;  ///< the coroutine that runs a slice of its work, if one does
    bool can_pause = false;      ///< what runs in it may end the slice
    bool pausing = false;        ///< it has, and all coroutines in between yield

    ScriptPlace expiry_place;        ///< where the script was when it was stopped
    ScriptPlace error_place;         ///< where an error was raised
    ScriptPlace error_caller;        ///< the behaviour's line that called the module in which that was, if one did
    ScriptPlace tail_caller;         ///< the function that was called, where its tail call has taken its place
    int tail_caller_end = 0;         ///< its last line
    std::size_t error_prefix = 0;    ///< bytes of the message that say that place
    bool is_deep_recursion = false;  ///< it was raised within a deep recursion
    bool closes = false;             ///< a coroutine was closed that is gone when an error of that is handled
    ScriptPlace closed;              ///< the file of the function in which it began; set when `closes` is
    char closed_file[LUA_IDSIZE];    ///< the same as Lua shortens it in messages
    int slice_status = LUA_OK;       ///< how a slice failed, whose error is raised again and has its place already
};

/// The innermost call of this thread, or null. Constant-initialised, hence a plain load.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler finds its thread's call by it
extern constinit thread_local CallRecord* current_call;

/// Whether this is what the innermost call or its slice runs in: a coroutine to Lua, and none to the script.
inline bool is_outside_coroutines(lua_State* lua) { return lua == current_call->base || lua == current_call->slice; }

/// Raises the error of an expired budget if it has expired. Library functions that loop call this in their loops.
void raise_expiry(lua_State* lua);
inline void poll_budget(lua_State* lua) {
    if (current_call->expired != 0) raise_expiry(lua);
}

/// What an outermost call does where setjmp on its `escape` has returned a second time: the states of all calls that
/// were under way are replaced by empty ones.
void finish_escape(CallRecord& outermost);

/// While this lives, the calls that are under way on this thread wait: their time does not count, and what is called
/// meanwhile is on its own. For functions that Lua calls and that let simulated time pass.
class CallPause {
public:
    CallPause();
    ~CallPause();
    CallPause(const CallPause&) = delete;
    CallPause& operator=(const CallPause&) = delete;

private:
    CallRecord* paused_;
    std::int64_t began_;
};

/// From now on the calls of this thread end as if their budgets were used up while `flag` is set, a few milliseconds of
/// CPU time later. It must outlive them.
void end_calls_when(const std::atomic<bool>& flag);

/// Counts what another thread did for the calls of this one as their own time [ns], and ends them at their next step
/// when it is used up or their flag is set.
void charge_calls(std::int64_t nanoseconds);

/// Ends the innermost call as if its budget were used up, whatever the script tries to catch. Raises a Lua error;
/// nothing around it may need a destructor. When the call's state was lost during a pause, leaves it by a jump.
[[noreturn]] void end_call(lua_State* lua);

/// Begins to watch the calls of this thread. False where that can't be: then nothing may be called.
bool watch_this_thread();

/// Whether nesting through C functions has used up what scripts may use of this thread's C stack, 1 MB.
bool c_stack_is_used_up();

/// Raises "C stack overflow" then. For functions that call Lua where Lua itself does not count: coroutines.
void check_c_stack(lua_State* lua);

/// Fills `place` with the innermost line of Lua code that runs.
void find_place(lua_State* lua, CallRecord::ScriptPlace& place);

/// CPU time of this thread [ns].
std::int64_t thread_time();

}  // namespace nezumi
