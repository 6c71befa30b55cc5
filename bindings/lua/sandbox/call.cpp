// From a Lua error to a place and a sentence.
#include "bindings/lua/sandbox/call.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/lua/sandbox/state.hpp"

namespace nezumi {
namespace {

constexpr std::size_t longest_message = 2000;  // [bytes]
constexpr int searched_levels = 100;

// The length of "file:line: " at the start of `message`, where `file` is shortened as Lua does it.
std::size_t prefix_length(const char* message, const char* file, int& line) {
    const std::size_t name = std::strlen(file);
    if (std::strncmp(message, file, name) != 0 || message[name] != ':') return 0;
    std::size_t end = name + 1;
    int number = 0;
    for (; message[end] >= '0' && message[end] <= '9' && number < 100'000'000; ++end) {
        number = number * 10 + (message[end] - '0');
    }
    if (end == name + 1 || message[end] != ':' || message[end + 1] != ' ') return 0;
    line = number;
    return end + 2;
}

// The place that the message itself names, if it names one of a function that runs, or of one that was closed; else the
// innermost line of Lua.
void find_error_place(lua_State* lua, CallRecord& call) {
    call.error_place.line = 0;
    call.error_prefix = 0;
    find_place(lua, call.error_place);
    if (lua_type(lua, -1) != LUA_TSTRING) return;
    const char* message = lua_tostring(lua, -1);
    int line = 0;
    lua_Debug activation;
    for (int level = 0; level < searched_levels && lua_getstack(lua, level, &activation) != 0; ++level) {
        if (lua_getinfo(lua, "Sl", &activation) == 0 || activation.currentline <= 0) continue;
        call.error_prefix = prefix_length(message, activation.short_src, line);
        if (call.error_prefix == 0) continue;
        activation.currentline = line;
        call.error_place.set(activation);
        return;
    }
    if (!call.closes) return;
    call.error_prefix = prefix_length(message, call.closed_file, line);
    if (call.error_prefix == 0) return;
    call.error_place = call.closed;
    call.error_place.line = line;
}

// The deepest level of the stack that there is.
int last_level(lua_State* lua) {
    lua_Debug activation;
    int below = 1;
    while (lua_getstack(lua, below, &activation) != 0) below *= 2;
    int there = below / 2;
    while (below - there > 1) {
        const int middle = there + (below - there) / 2;
        (lua_getstack(lua, middle, &activation) != 0 ? there : below) = middle;
    }
    return there;
}

// Whether an activation is one of Lua code; its place then.
bool is_lua(lua_State* lua, lua_Debug& activation, CallRecord::ScriptPlace& place) {
    if (lua_getinfo(lua, "Sl", &activation) == 0 || activation.currentline <= 0) return false;
    place.set(activation);
    return true;
}

// The line of the behaviour that called the module in which an error is: the innermost one of the file in which this
// coroutine began.
void find_caller(lua_State* lua, const CallRecord::ScriptPlace& error, CallRecord::ScriptPlace& caller) {
    caller.line = 0;
    lua_Debug activation;
    CallRecord::ScriptPlace found;
    found.line = 0;
    for (int level = last_level(lua); level >= 0 && lua_getstack(lua, level, &activation) != 0; --level) {
        if (is_lua(lua, activation, found)) break;
    }
    if (error.line == 0 || found.line == 0 || std::strcmp(found.file, error.file) == 0) return;
    caller = found;
    for (int level = 0; level < searched_levels && lua_getstack(lua, level, &activation) != 0; ++level) {
        if (!is_lua(lua, activation, found) || std::strcmp(found.file, caller.file) != 0) continue;
        caller = found;
        return;
    }
}

// What is known of an error on top of the stack of `lua` where it was raised.
void note_error(lua_State* lua, CallRecord& call) {
    find_error_place(lua, call);
    find_caller(lua, call.error_place, call.error_caller);
}

std::string shown_number(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
}

Place to_place(const CallRecord::ScriptPlace& place) {
    if (place.line == 0) return {};
    return {place.file, place.line};
}

std::string describe_value(lua_State* lua, std::size_t prefix) {
    switch (lua_type(lua, -1)) {
        case LUA_TSTRING:
        case LUA_TNUMBER: {
            std::size_t length = 0;
            const char* text = lua_tolstring(lua, -1, &length);
            if (prefix <= length) text += prefix, length -= prefix;
            if (length <= longest_message) return {text, length};
            return fmt::format("{}...", std::string_view(text, longest_message));
        }
        case LUA_TNIL: return "an error of value nil";
        default: return fmt::format("an error of type {}", luaL_typename(lua, -1));
    }
}

CallError error_of_memory(const LuaState& state, const CallRecord& call) {
    std::string message = "not enough memory";
    if (call.memory_refused) {
        message = call.memory_refused_deep ? "stack overflow: the recursion is too deep for the script's limit of "
                                           : "not enough memory: the script reached its limit of ";
        message += shown_number(static_cast<double>(state.memory_limit()) / (1 << 20)) + " MB";
    }
    return {{message, to_place(call.memory_place)}, false};
}

// The message handler of every call.
int handle_error(lua_State* lua) {
    CallRecord& call = *current_call;
    if (call.expired != 0) {
        if (call.expiry_place.line == 0) find_place(lua, call.expiry_place);
        return 1;
    }
    if (lua_type(lua, 1) != LUA_TSTRING && luaL_getmetafield(lua, 1, "__tostring") != LUA_TNIL) {
        // If this fails, it is another error, which begins here.
        const int slice_status = std::exchange(call.slice_status, LUA_OK);
        lua_pushvalue(lua, 1);
        lua_call(lua, 1, 1);
        call.slice_status = slice_status;
        if (lua_type(lua, -1) != LUA_TSTRING) lua_settop(lua, 1);
    }
    if (call.slice_status == LUA_OK) note_error(lua, call);
    if (lua_type(lua, -1) == LUA_TSTRING && call.error_caller.line != 0) {
        lua_pushfstring(lua, " (called from %s:%d)", call.error_caller.file, call.error_caller.line);
        lua_concat(lua, 2);
    }
    return 1;
}

// What went wrong, from the error value that a failed lua_pcall left on top of the stack, which is popped. `status` is
// its result; `call` is the record of the call that failed.
CallError take_error(lua_State* lua, int status, const CallRecord& call) {
    const LuaState& state = LuaState::of(lua);
    CallError error;
    if (call.expired != 0) {
        error = {{"ran for more than " + shown_number(call.budget_seconds) + " s: is there an endless loop?",
                  to_place(call.expiry_place.line != 0 ? call.expiry_place : call.memory_place)},
                 true};
    } else if (status == LUA_ERRMEM || call.slice_status == LUA_ERRMEM) {
        error = error_of_memory(state, call);
    } else {
        // What could not be handled is not the message whose place was found.
        const std::size_t prefix = status == LUA_ERRERR ? 0 : call.error_prefix;
        error = {{describe_value(lua, prefix), to_place(call.error_place)}, false};
        error.message += state.hint(error);
    }
    if (call.seen != 0) error.used_seconds = static_cast<double>(thread_time() - call.seen) * 1e-9;
    lua_pop(lua, 1);
    return error;
}

// What is said of a call that had to be left in the middle of Lua's own code.
CallError lost_error(double budget_seconds) {
    return {{"ran for more than " + shown_number(budget_seconds) +
             " s inside Lua itself, where it could not be stopped: the script is lost, load it again"},
            true,
            budget_seconds};
}

}  // namespace

void note_slice_error(lua_State* coroutine, int status) {
    note_error(coroutine, *current_call);
    current_call->slice_status = status;
}

void note_closed(lua_State* coroutine) {
    CallRecord& call = *current_call;
    lua_Debug activation;
    const int level = last_level(coroutine);
    call.closes = lua_getstack(coroutine, level, &activation) != 0 && lua_getinfo(coroutine, "Sl", &activation) != 0;
    if (!call.closes) return;
    // The function may be gone, and its source with it, when the error is handled.
    call.closed.set(activation);
    std::memcpy(call.closed_file, activation.short_src, sizeof call.closed_file);
}

CallResult protected_call(lua_State* lua, int arguments, int results, Budget budget) {
    const int function = lua_gettop(lua) - arguments;
    if (LuaState::of(lua).is_lost()) {
        lua_settop(lua, function - 1);
        return tl::unexpected(
            CallError{{"the script is lost: it had to be stopped inside Lua itself; load it again"}, false});
    }
    if (lua_checkstack(lua, 2) == 0 || c_stack_is_used_up()) {
        lua_settop(lua, function - 1);
        return tl::unexpected(CallError{{"stack overflow: calls are nested too deep"}, false});
    }
    CallRecord call(lua, budget);
    if (call.outer == nullptr) {
        if (_setjmp(call.escape) != 0) {
            finish_escape(call);
            return tl::unexpected(lost_error(call.budget_seconds));
        }
        call.can_escape = true;
    }
    lua_pushcfunction(lua, handle_error);
    lua_insert(lua, function);
    const int status = lua_pcall(lua, arguments, results, function);
    lua_remove(lua, function);
    if (status == LUA_OK) {
        call.can_escape = false;
        return {};
    }
    // What the script had gathered is garbage now; nobody may call it again for a long time.
    const LuaState& state = LuaState::of(lua);
    call.can_escape = false;
    if (state.memory() > state.memory_limit() / 2) lua_gc(lua, LUA_GCCOLLECT);
    return tl::unexpected(take_error(lua, status, call));
}

}  // namespace nezumi
