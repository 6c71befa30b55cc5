// The library `coroutine`: the watchdog follows its coroutines, and they can pause with their task.
#include <cstdint>
#include <utility>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/error_frames.hpp"
#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/slices.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi::library {
namespace {

lua_State* check_coroutine(lua_State* lua, int index) {
    lua_State* coroutine = lua_tothread(lua, index);
    luaL_argexpected(lua, coroutine != nullptr, index, "coroutine");
    return coroutine;
}

// A coroutine that has paused continues only with its task. Until then, a bit of the pointer in its extra space is set,
// so that scripts can't resume or close it; nothing else reads the pointer meanwhile. If the pause began in an inner
// coroutine, that coroutine is on top of the stack.
constexpr std::uintptr_t paused_bit = 1;
static_assert(alignof(LuaState) > paused_bit);

std::uintptr_t& mark_of(lua_State* coroutine) { return *static_cast<std::uintptr_t*>(lua_getextraspace(coroutine)); }
bool has_paused(lua_State* coroutine) { return (mark_of(coroutine) & paused_bit) != 0; }
void set_paused(lua_State* coroutine) { mark_of(coroutine) |= paused_bit; }
void unset_paused(lua_State* coroutine) { mark_of(coroutine) &= ~paused_bit; }

// Removes the bit from a coroutine and all inner ones that have paused, because they will not continue.
void unset_all_paused(lua_State* coroutine) {
    while (coroutine != nullptr && has_paused(coroutine)) {
        unset_paused(coroutine);
        coroutine = lua_gettop(coroutine) > 0 ? lua_tothread(coroutine, -1) : nullptr;
    }
}

// Like lua_resume, but the watchdog follows the coroutine. Raises an error if the time limit is reached.
int resume_watched(lua_State* lua, lua_State* coroutine, int arguments, int& results) {
    CallRecord& call = *current_call;
    unset_paused(coroutine);
    const bool could_pause = call.can_pause;
    call.can_pause = could_pause && (lua_isyieldable(lua) != 0 || coroutine == call.slice);
    call.running = coroutine;
    const int status = lua_resume(coroutine, lua, arguments, &results);
    call.running = lua;
    call.can_pause = could_pause;
    if (status == LUA_YIELD && call.pausing) set_paused(coroutine);
    if (call.expired == 0) return status;
    if (status == LUA_OK || status == LUA_YIELD) {
        lua_pop(coroutine, results);
    } else {
        poison(coroutine);
    }
    raise_expiry(lua);
    return status;
}

constexpr int failed = -1;

// Runs `coroutine`, with `arguments` values on top of its stack, until it yields, returns or fails. Returns the number
// of results on top of the caller's stack, or `failed` with the error there. If it pauses, the caller pauses as well,
// with the coroutine on top of its stack, and `go_on` continues.
int run(lua_State* lua, lua_State* coroutine, int arguments, lua_KFunction go_on) {
    int results = 0;
    const int status = resume_watched(lua, coroutine, arguments, results);
    if (status == LUA_YIELD && current_call->pausing) return lua_yieldk(lua, 0, 0, go_on);
    if (status != LUA_OK && status != LUA_YIELD) {
        lua_xmove(coroutine, lua, 1);
        return failed;
    }
    if (lua_checkstack(lua, results + 1) == 0) {
        lua_pop(coroutine, results);
        lua_pushliteral(lua, "too many results to resume");
        return failed;
    }
    lua_xmove(coroutine, lua, results);
    return results;
}

// Moves `count` arguments from the caller to the coroutine. If this is impossible, returns false, with the error on the
// caller's stack.
bool give_arguments(lua_State* lua, lua_State* coroutine, int count) {
    check_c_stack(lua);
    if (has_paused(coroutine)) {
        lua_pushliteral(lua, "a coroutine that waits in a task can only be resumed by that task");
        return false;
    }
    if (lua_checkstack(coroutine, count) == 0) {
        lua_pushliteral(lua, "too many arguments to resume");
        return false;
    }
    lua_xmove(lua, coroutine, count);
    return true;
}

int finish_resume(lua_State* lua, int results) {
    if (results == failed) forget_inner_error();
    lua_pushboolean(lua, results == failed ? 0 : 1);
    lua_insert(lua, results == failed ? -2 : -(results + 1));
    return results == failed ? 2 : results + 1;
}

int go_on_resume(lua_State* lua, int, lua_KContext) {
    return finish_resume(lua, run(lua, lua_tothread(lua, 1), 0, go_on_resume));
}

int resume(lua_State* lua) {
    lua_State* coroutine = check_coroutine(lua, 1);
    const int arguments = lua_gettop(lua) - 1;
    if (!give_arguments(lua, coroutine, arguments)) return finish_resume(lua, failed);
    return finish_resume(lua, run(lua, coroutine, arguments, go_on_resume));
}

// Closes the to-be-closed variables of a coroutine that is not running; during this `closes` is true. Returns whether
// this succeeded; otherwise the error is on the stack of the coroutine.
bool reset(lua_State* lua, lua_State* coroutine, bool& closes) {
    check_c_stack(lua);
    current_call->running = coroutine;
    const bool closed_before = std::exchange(closes, true);  // closing may close other coroutines
    const int status = close_coroutine(coroutine, lua);      // catches errors of closing
    closes = closed_before;
    current_call->running = lua;
    poll_budget(lua);
    return status == LUA_OK;
}

bool reset(lua_State* lua, lua_State* coroutine) {
    bool closes = false;
    return reset(lua, coroutine, closes);
}

int finish_wrapped(lua_State* lua, lua_State* coroutine, int results) {
    if (results != failed) return results;
    const int status = lua_status(coroutine);
    if (status != LUA_OK && status != LUA_YIELD && !is_poisoned(coroutine)) {
        note_inner_error(lua, coroutine);
        if (!reset(lua, coroutine)) lua_xmove(coroutine, lua, 1);
    }
    return lua_error(lua);
}

int go_on_wrapped(lua_State* lua, int, lua_KContext) {
    lua_State* coroutine = lua_tothread(lua, lua_upvalueindex(1));
    return finish_wrapped(lua, coroutine, run(lua, coroutine, 0, go_on_wrapped));
}

int call_wrapped(lua_State* lua) {
    lua_State* coroutine = lua_tothread(lua, lua_upvalueindex(1));
    const int arguments = lua_gettop(lua);
    if (!give_arguments(lua, coroutine, arguments)) return luaL_error(lua, "%s", lua_tostring(lua, -1));
    lua_pushvalue(lua, lua_upvalueindex(1));
    return finish_wrapped(lua, coroutine, run(lua, coroutine, arguments, go_on_wrapped));
}

int create(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TFUNCTION);
    lua_State* coroutine = lua_newthread(lua);
    lua_pushvalue(lua, 1);
    lua_xmove(lua, coroutine, 1);
    return 1;
}

int wrap(lua_State* lua) {
    create(lua);
    lua_pushcclosure(lua, call_wrapped, 1);
    return 1;
}

enum class Status : unsigned char { suspended, running, normal, dead };

Status status_of(lua_State* lua, lua_State* coroutine) {
    if (lua == coroutine) return Status::running;
    switch (lua_status(coroutine)) {
        case LUA_YIELD: return Status::suspended;
        case LUA_OK: {
            lua_Debug activation;
            if (lua_getstack(coroutine, 0, &activation) != 0) return Status::normal;
            return lua_gettop(coroutine) == 0 ? Status::dead : Status::suspended;
        }
        default: return Status::dead;
    }
}

constexpr const char* status_names[] = {"suspended", "running", "normal", "dead"};

int status(lua_State* lua) {
    lua_pushstring(lua, status_names[static_cast<int>(status_of(lua, check_coroutine(lua, 1)))]);
    return 1;
}

int close(lua_State* lua) {
    lua_State* coroutine = check_coroutine(lua, 1);
    const Status status = status_of(lua, coroutine);
    if (status != Status::suspended && status != Status::dead) {
        return luaL_error(lua, "cannot close a %s coroutine", status_names[static_cast<int>(status)]);
    }
    if (has_paused(coroutine))
        return luaL_error(lua, "a coroutine that waits in a task can only be closed by that task");
    if (is_poisoned(coroutine)) {
        lua_pushboolean(lua, 0);
        lua_pushliteral(lua, "the coroutine ran for too long");
        return 2;
    }
    const bool well = reset(lua, coroutine);
    lua_pushboolean(lua, well ? 1 : 0);
    if (well) return 1;
    lua_xmove(coroutine, lua, 1);
    return 2;
}

int yield(lua_State* lua) {
    if (is_outside_coroutines(lua)) return luaL_error(lua, "attempt to yield from outside a coroutine");
    return lua_yield(lua, lua_gettop(lua));
}

int is_yieldable(lua_State* lua) {
    lua_State* coroutine = lua_isnone(lua, 1) ? lua : check_coroutine(lua, 1);
    lua_pushboolean(lua, lua_isyieldable(coroutine) != 0 && !is_outside_coroutines(coroutine) ? 1 : 0);
    return 1;
}

int running(lua_State* lua) {
    lua_pushthread(lua);
    lua_pushboolean(lua, is_outside_coroutines(lua) ? 1 : 0);
    return 2;
}

}  // namespace

const Entries& coroutine() {
    static const Entries entries = {{"close", close},   {"create", create},   {"isyieldable", is_yieldable},
                                    {"resume", resume}, {"running", running}, {"status", status},
                                    {"wrap", wrap},     {"yield", yield}};
    return entries;
}

}  // namespace nezumi::library

namespace nezumi {

SliceEnd run_slice(lua_State* lua, lua_State* coroutine) {
    CallRecord& call = *current_call;
    check_c_stack(lua);
    luaL_checkstack(lua, 1, nullptr);
    call.slice = coroutine;
    call.can_pause = true;
    int results = 0;
    const int status = library::resume_watched(lua, coroutine, 0, results);
    call.slice = nullptr;
    call.can_pause = call.pausing = false;
    if (status == LUA_YIELD) return SliceEnd::paused;
    if (status == LUA_OK) {
        lua_pop(coroutine, results);
        return SliceEnd::returned;
    }
    note_slice_error(coroutine, status);
    lua_xmove(coroutine, lua, 1);
    return SliceEnd::failed;
}

bool can_pause(lua_State* lua) { return current_call->can_pause && lua_isyieldable(lua) != 0; }

int pause(lua_State* lua, lua_KContext context, lua_KFunction go_on) {
    current_call->pausing = true;
    return lua_yieldk(lua, 0, context, go_on);
}

bool close_slices(lua_State* lua, lua_State* coroutine, bool& closes) {
    if (is_poisoned(coroutine)) return true;
    const bool has_failed = lua_status(coroutine) != LUA_YIELD;  // its error is already stored
    luaL_checkstack(lua, 1, nullptr);
    library::unset_all_paused(coroutine);
    note_closed(coroutine);
    if (library::reset(lua, coroutine, closes) || has_failed) return true;
    lua_xmove(coroutine, lua, 1);
    return false;
}

}  // namespace nezumi
