// Ends a call into Lua that runs for too long: the record of a call, and the timer that checks it.
//
// A count hook slows Lua down, whatever its interval, so none is set while a call is within its time. Entering a call
// adds a record to its thread, which takes a few nanoseconds. A timer of the thread's CPU time interrupts the thread
// every few milliseconds, and its signal handler checks the age of the record. The handler sets a hook on the running
// coroutine only if the age exceeds the limit, and again at each interruption until the call has returned; so the error
// is raised again if the script catches it (pcall, coroutines, __close).
#pragma once

#include <atomic>
#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <memory>

#include "engine/base/error.hpp"
#include "engine/components/budget.hpp"

namespace nezumi {

class LuaState;

/// The limit of steps of pattern functions in one call into Lua.
inline constexpr std::int64_t pattern_step_budget = 5'000'000;

/// One call into Lua, on the C++ stack of its thread. Made only by `protected_call`.
class CallRecord {
public:
    /// `thread`: the coroutine in which it will run.
    CallRecord(lua_State* thread, Budget budget);
    ~CallRecord();
    CallRecord(const CallRecord&) = delete;
    CallRecord& operator=(const CallRecord&) = delete;

    /// A location in a script, in plain memory, because it is written where no error may occur.
    struct ScriptPlace {
        int line = 0;    ///< 0: not known
        char file[256];  ///< set when `line` is
        void set(const lua_Debug& activation);
    };

    lua_State* const base;                   ///< the coroutine of the call; the script does not see it as a coroutine
    lua_State* volatile running;             ///< the coroutine that runs and would be interrupted
    CallRecord* const outer;                 ///< the call around this one
    volatile std::sig_atomic_t expired = 0;  ///< the time limit of this call, or of one around it, is reached
    volatile std::int64_t seen = 0;          ///< [ns] CPU time when the timer first found this call
    std::int64_t next_hook = 0;              ///< [ns] when the timer may set the hook again
    std::int64_t budget_ns;                  ///< [ns] from `seen` to the end of the time limit
    const std::atomic<bool>* const stop;     ///< if this is set, the time limit counts as reached; may be null
    std::int64_t expired_at = 0;             ///< [ns] when the timer found the limit reached
    int looks_since_expiry = 0;              ///< how often the timer has found the limit reached
    double budget_seconds;                   ///< for the message
    std::int64_t pattern_steps = pattern_step_budget;
    const char* stack_base;  ///< the C stack at the outermost call of the thread

    /// Where to jump if the time limit is reached in Lua's own C code, where no hook runs. Only the outermost call of
    /// the thread uses it, and it is valid only while `can_escape` is true.
    std::jmp_buf escape;
    volatile bool can_escape = false;

    lua_State* slice = nullptr;  ///< the coroutine that runs a slice, if one does
    bool can_pause = false;      ///< code in the slice may pause, which ends the slice
    bool pausing = false;        ///< the slice is pausing: all coroutines within it yield

    ScriptPlace expiry_place;      ///< where the script was stopped
    ScriptPlace error_place;       ///< where an error was raised
    ScriptPlace error_caller;      ///< the line of the behaviour that called the module with the error, if there is one
    ScriptPlace tail_caller;       ///< the function that was called, if a tail call has replaced it
    int tail_caller_end = 0;       ///< its last line
    std::size_t error_prefix = 0;  ///< bytes of the message that contain the place
    std::shared_ptr<const ErrorFrames> error_frames{};  ///< the functions that were running
    bool is_deep_recursion = false;                     ///< the error was raised within a deep recursion
    bool closes = false;           ///< a coroutine was closed that no longer exists when its error is handled
    ScriptPlace closed;            ///< the file in which that coroutine began; set if `closes`
    char closed_file[LUA_IDSIZE];  ///< the name of that file, as Lua shortens it in messages
    int slice_status = LUA_OK;     ///< the error of a failed slice, which is raised again and already has its location
};

/// The innermost call of this thread, or null. Constant-initialised, so reading it is a plain load.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler finds its thread's call by it
extern constinit thread_local CallRecord* current_call;

/// Whether this is the coroutine of the innermost call or its slice: a coroutine for Lua, but not for the script.
inline bool is_outside_coroutines(lua_State* lua) { return lua == current_call->base || lua == current_call->slice; }

/// `raise_expiry` raises the error of the time limit, `poll_budget` only if the limit is reached. Library functions
/// call `poll_budget` in their loops.
void raise_expiry(lua_State* lua);
inline void poll_budget(lua_State* lua) {
    if (current_call->expired != 0) raise_expiry(lua);
}

/// Called by the outermost call after the jump to `escape`: replaces the states of all active calls by empty ones.
void finish_escape(CallRecord& outermost);

/// During its lifetime, the active calls of this thread are paused: their time does not count, and new calls are
/// independent of them. For functions that Lua calls and that let simulated time pass.
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

/// While `flag` is set, calls of this thread end as if their time limits were reached, after a few milliseconds of CPU
/// time. `flag` must outlive the calls.
void end_calls_when(const std::atomic<bool>& flag);

/// Adds time [ns] to the calls of this thread: time that another thread used for them, or, if negative, time of hooks
/// that does not count. Ends the calls at their next step if the limit is reached or their flag is set.
void charge_calls(std::int64_t nanoseconds);

/// Ends the innermost call as if its time limit were reached; the script can't catch this. Raises a Lua error, so no
/// object around it may need a destructor. If the state of the call was lost during a pause, jumps out of the call
/// instead.
[[noreturn]] void end_call(lua_State* lua);

/// Whether a hook for another purpose, such as a trace, may be set on this coroutine: it has none, or only the one that
/// checks the time in a web page.
bool has_free_hook(lua_State* lua);
/// Removes a hook for another purpose.
void free_hook(lua_State* lua);
/// Hooks for other purposes call this: in a web page, where there is no timer, it ends a call that is over its time
/// limit. May raise a Lua error.
void look_at_time(lua_State* lua);

/// Starts watching the calls of this thread. False if this is impossible; then no call into Lua may be made.
bool watch_this_thread();

/// Whether nested calls through C functions have used the C stack that scripts may use in this thread, 1 MB.
bool c_stack_is_used_up();

/// Raises the error "C stack overflow" if `c_stack_is_used_up`. For functions that call Lua where Lua itself does not
/// count: coroutines.
void check_c_stack(lua_State* lua);

/// Stores the innermost line of running Lua code in `place`.
void find_place(lua_State* lua, CallRecord::ScriptPlace& place);

/// CPU time of this thread [ns].
std::int64_t thread_time();

}  // namespace nezumi
