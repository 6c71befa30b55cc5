// The timer of each thread, its signal handler, and the hook that the handler sets.
#include "bindings/lua/sandbox/watchdog.hpp"

#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "bindings/lua/sandbox/lua_text.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/thread_timer.hpp"
#include "engine/base/sanitizers.hpp"

#if defined(NEZUMI_THREAD_SANITIZER)
// ThreadSanitizer must see every jump, or its count of calls becomes wrong; Debian's Lua jumps with a function that the
// sanitizer does not know.
extern "C" void __longjmp_chk(jmp_buf target, int value) { longjmp(target, value); }
// The sanitizer records each call of a function. In a handler that interrupts the sanitizer itself, this would be a
// deadlock.
#define NEZUMI_IN_SIGNAL __attribute__((disable_sanitizer_instrumentation))
// The handler must not call functions that the sanitizer intercepts.
#define NEZUMI_CLOCK_GETTIME(clock, time) syscall(SYS_clock_gettime, clock, time)
#define NEZUMI_CAN_LEAVE false
#elif defined(__EMSCRIPTEN__)
// Nothing interrupts a web page's program, and it has no clock of the thread's own time.
#define NEZUMI_IN_SIGNAL
#define NEZUMI_CLOCK_GETTIME(clock, time) clock_gettime(CLOCK_MONOTONIC, time)
#define NEZUMI_CAN_LEAVE false
#define NEZUMI_POLLS 1
#else
#define NEZUMI_IN_SIGNAL
#define NEZUMI_CLOCK_GETTIME(clock, time) clock_gettime(clock, time)
#define NEZUMI_CAN_LEAVE true
#endif

namespace nezumi {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler finds its thread's call by it
constinit thread_local CallRecord* current_call = nullptr;

namespace {

constexpr std::int64_t shortest_grace_ns = 50'000'000, longest_grace_ns = 1'000'000'000;
constexpr std::int64_t longest_hook_pause_ns = 20'000'000;
constexpr std::ptrdiff_t c_stack_limit = std::ptrdiff_t{1} << 20;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): each thread has its own
constinit thread_local const std::atomic<bool>* stop_flag = nullptr;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): from a signal handler to the place it jumps to
constinit thread_local LuaState* lost_states = nullptr;

NEZUMI_IN_SIGNAL bool is_set(const std::atomic<bool>* flag) {
    return flag != nullptr && flag->load(std::memory_order_relaxed);
}

NEZUMI_IN_SIGNAL std::int64_t nanoseconds(const timespec& time) {
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

// Additional time for Lua's own C code before it is abandoned. Normally this code returns much sooner to the next
// instruction of the script, where a hook ends the call, unless the script prevents this on purpose.
NEZUMI_IN_SIGNAL std::int64_t grace_ns(double budget_seconds) {
    const auto half = static_cast<std::int64_t>(budget_seconds * 0.5e9);
    if (half < shortest_grace_ns) return shortest_grace_ns;
    return half < longest_grace_ns ? half : longest_grace_ns;
}

// Whether the additional time is over. In a virtual machine, time of other programs may count as time of the thread, so
// the clock is not enough: the timer must also have interrupted the thread several times since the limit, on average at
// least once in four periods (some systems have coarse timers).
NEZUMI_IN_SIGNAL bool grace_is_over(const CallRecord& call, std::int64_t now) {
    const std::int64_t grace = grace_ns(call.budget_seconds);
    return now - call.expired_at > grace && call.looks_since_expiry > grace / (4 * ThreadTimer::period);
}

NEZUMI_IN_SIGNAL std::int64_t time_in_signal() {
    timespec time{};
    NEZUMI_CLOCK_GETTIME(CLOCK_THREAD_CPUTIME_ID, &time);
    return nanoseconds(time);
}

// The hook that stops a script. Removes itself if there is nothing to do.
void watch_hook(lua_State* lua, lua_Debug*) {
    CallRecord* const call = current_call;
    if (call == nullptr) return free_hook(lua);
    if (call->expired == 0) return free_hook(lua);  // the hook remains from a call that was stopped
    // The hook stays set: every further instruction raises the error again, also in handlers and in to-be-closed
    // variables.
    raise_expiry(lua);
}

// Jumps out of Lua's own C code, over frames of C and C++ functions that Lua errors skip as well.
NEZUMI_IN_SIGNAL void leave_lua(CallRecord* innermost) {
    CallRecord* outermost = innermost;
    while (outermost->outer != nullptr) outermost = outermost->outer;
    if (!outermost->can_escape) return;
    outermost->can_escape = false;
    for (CallRecord* call = innermost; call != nullptr; call = call->outer) {
        LuaState& state = LuaState::of(call->running);
        if (!state.is_lost()) state.lose(lost_states);
    }
    _longjmp(outermost->escape, 1);
}

// Runs in the watched thread, between any two of its instructions. It only reads the clock and calls lua_sethook, which
// Lua allows here.
NEZUMI_IN_SIGNAL void on_tick(int, siginfo_t*, void* context) {
    const int saved_errno = errno;
    CallRecord* const innermost = current_call;
    const std::int64_t now = time_in_signal();
    CallRecord* expired = nullptr;  // the outermost one
    for (CallRecord* call = innermost; call != nullptr; call = call->outer) {
        if (call->seen == 0) call->seen = now;
        if (now - call->seen >= call->budget_ns || is_set(call->stop)) expired = call;
    }
    // Inner calls end with the outer call that waits for them.
    for (CallRecord* call = expired != nullptr ? innermost : nullptr; call != nullptr; call = call->outer) {
        call->budget_seconds = expired->budget_seconds;
        if (call->expired == 0) call->expired_at = now;
        call->expired = 1;
        ++call->looks_since_expiry;
        // Setting a hook visits every function on the stack, which may take longer than the time between two ticks;
        // then the script would never reach the instruction that raises the error.
        if (now >= call->next_hook) {
            lua_sethook(call->running, watch_hook, LUA_MASKCOUNT, 1);
            const std::int64_t done = time_in_signal();
            call->next_hook = done + std::min(8 * (done - now), longest_hook_pause_ns);
        }
        if (call == expired) break;
    }
    errno = saved_errno;
    if (NEZUMI_CAN_LEAVE && expired != nullptr && grace_is_over(*innermost, now) && was_in_lua(context))
        leave_lua(innermost);
}

#if defined(NEZUMI_POLLS)
constexpr int poll_interval = 10'000;  // instructions

void look(lua_State* lua, lua_Debug* /*activation*/) {
    on_tick(0, nullptr, nullptr);
    if (current_call != nullptr && current_call->expired != 0) watch_hook(lua, nullptr);
}
#endif

enum class Watch : unsigned char { not_yet, runs, impossible };
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a timer belongs to its thread
constinit thread_local Watch watch = Watch::not_yet;

void forget_timer() { watch = Watch::not_yet; }

struct WatchTimer : ThreadTimer {
    ~WatchTimer() { watch = Watch::impossible; }  // for calls at the end of the thread
};

}  // namespace

#if defined(NEZUMI_POLLS)
bool has_free_hook(lua_State* lua) { return lua_gethook(lua) == nullptr || lua_gethook(lua) == look; }
void free_hook(lua_State* lua) { lua_sethook(lua, look, LUA_MASKCOUNT, poll_interval); }
void look_at_time(lua_State* lua) { look(lua, nullptr); }
#else
bool has_free_hook(lua_State* lua) { return lua_gethook(lua) == nullptr; }
void free_hook(lua_State* lua) { lua_sethook(lua, nullptr, 0, 0); }
void look_at_time(lua_State* /*lua*/) {}
#endif

bool watch_this_thread() {
    if (watch == Watch::runs) return true;
    if (watch == Watch::impossible) return false;
    static const int once = [] {
        find_lua_text();
#if !defined(NEZUMI_POLLS)
        // The child of a fork has the variables of its parent, but not its timers, so it must start its own.
        return pthread_atfork(nullptr, nullptr, forget_timer);
#else
        return 0;
#endif
    }();
    static_cast<void>(once);
    static thread_local WatchTimer timer;
    if (timer.restart(on_tick)) watch = Watch::runs;
    return watch == Watch::runs;
}

void CallRecord::ScriptPlace::set(const lua_Debug& activation) {
    const char* name = *activation.source == '@' ? activation.source + 1 : activation.short_src;
    std::strncpy(file, name, sizeof file - 1);
    file[sizeof file - 1] = '\0';
    line = activation.currentline;
}

CallRecord::CallRecord(lua_State* thread, Budget budget)
    : base(thread),
      running(thread),
      outer(current_call),
      budget_ns(static_cast<std::int64_t>(budget.seconds * 1e9)),
      stop(stop_flag),
      budget_seconds(budget.seconds),
      stack_base(outer != nullptr ? outer->stack_base : static_cast<const char*>(__builtin_frame_address(0))) {
    std::atomic_signal_fence(std::memory_order_seq_cst);
    current_call = this;
#if defined(NEZUMI_POLLS)
    if (lua_gethook(thread) == nullptr) free_hook(thread);
#endif
}

CallRecord::~CallRecord() {
    current_call = outer;
    std::atomic_signal_fence(std::memory_order_seq_cst);
}

void finish_escape(CallRecord& outermost) {
    current_call = &outermost;
    while (lost_states != nullptr) lost_states = lost_states->replace_lost();
    ThreadTimer::unblock();  // still blocked, because the handler never returned
}

void raise_expiry(lua_State* lua) {
    CallRecord& call = *current_call;
    if (call.expiry_place.line == 0) find_place(lua, call.expiry_place);
    lua_pushnil(lua);  // no text, because it could need memory; protected_call makes its own
    lua_error(lua);
}

CallPause::CallPause() : paused_(current_call), began_(thread_time()) {
    current_call = nullptr;
    std::atomic_signal_fence(std::memory_order_seq_cst);
}

CallPause::~CallPause() {
    const std::int64_t passed = thread_time() - began_;
    for (CallRecord* call = paused_; call != nullptr; call = call->outer) {
        if (call->seen != 0) call->seen = call->seen + passed;
    }
    std::atomic_signal_fence(std::memory_order_seq_cst);
    current_call = paused_;
}

void end_calls_when(const std::atomic<bool>& flag) { stop_flag = &flag; }

namespace {

// Ends the calls from the innermost to this one at their next step.
void expire_calls(const CallRecord& outermost) {
    for (CallRecord* call = current_call; call != nullptr; call = call->outer) {
        call->budget_seconds = outermost.budget_seconds;
        if (call->expired == 0) call->expired_at = thread_time();
        call->expired = 1;
        lua_sethook(call->running, watch_hook, LUA_MASKCOUNT, 1);
        if (call == &outermost) return;
    }
}

}  // namespace

void charge_calls(std::int64_t nanoseconds) {
    const CallRecord* expired = nullptr;  // the outermost one
    for (CallRecord* call = current_call; call != nullptr; call = call->outer) {
        call->budget_ns -= nanoseconds;
        if (call->budget_ns <= 0 || is_set(call->stop)) expired = call;
    }
    if (expired != nullptr) expire_calls(*expired);
}

void end_call(lua_State* lua) {
    CallRecord& call = *current_call;
    if (LuaState::of(call.running).is_lost()) {
        CallRecord* outermost = &call;
        while (outermost->outer != nullptr) outermost = outermost->outer;
        outermost->can_escape = false;
        _longjmp(outermost->escape, 1);
    }
    if (call.expired == 0) call.expired_at = thread_time();
    call.expired = 1;
    lua_sethook(call.running, watch_hook, LUA_MASKCOUNT, 1);
    raise_expiry(lua);
    std::abort();  // raise_expiry does not return
}

void find_place(lua_State* lua, CallRecord::ScriptPlace& place) {
    lua_Debug activation;
    for (int level = 0; level < 250 && lua_getstack(lua, level, &activation) != 0; ++level) {
        if (lua_getinfo(lua, "Sl", &activation) != 0 && activation.currentline > 0) {
            return place.set(activation);
        }
    }
}

bool c_stack_is_used_up() {
    const auto* here = static_cast<const char*>(__builtin_frame_address(0));
    return current_call != nullptr && current_call->stack_base - here > c_stack_limit;
}

void check_c_stack(lua_State* lua) {
    if (c_stack_is_used_up()) luaL_error(lua, "C stack overflow");
}

std::int64_t thread_time() {
    timespec now{};
    NEZUMI_CLOCK_GETTIME(CLOCK_THREAD_CPUTIME_ID, &now);
    return nanoseconds(now);
}

}  // namespace nezumi
