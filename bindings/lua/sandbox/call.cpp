// Converts a Lua error to a message with its location.
#include "bindings/lua/sandbox/call.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/lua/sandbox/error_frames.hpp"
#include "bindings/lua/sandbox/inspect.hpp"
#include "bindings/lua/sandbox/line_trace.hpp"
#include "bindings/lua/sandbox/state.hpp"

namespace nezumi {
namespace {

constexpr std::size_t longest_message = 2000;  // [bytes]
constexpr int searched_levels = 100;
constexpr int deep_recursion = 20'000;  // number of nested calls

// The length of "file:line: " at the start of `message`, or 0. `file` is the name as Lua shortens it in messages.
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

// Finds the location of an error: the one that the message names, if it is in a file of a running function or of a
// closed coroutine; otherwise the innermost line of Lua.
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

// The level of the outermost function on the stack.
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

// Whether a stack frame is a Lua function; if so, returns its location.
bool is_lua(lua_State* lua, lua_Debug& activation, CallRecord::ScriptPlace& place) {
    if (lua_getinfo(lua, "Sl", &activation) == 0 || activation.currentline <= 0) return false;
    place.set(activation);
    return true;
}

// Finds the line of the behaviour that called the module with the error: the innermost line of the file in which this
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

// Finds the function that was called from outside, if a tail call has replaced it by the outermost function on the
// stack.
void find_tail_caller(lua_State* lua, CallRecord& call) {
    call.tail_caller.line = 0;
    lua_Debug activation;
    CallRecord::ScriptPlace found;
    int level = last_level(lua);
    bool is_found = false;
    for (; level >= 0 && lua_getstack(lua, level, &activation) != 0; --level) {
        is_found = is_lua(lua, activation, found);
        if (is_found) break;
    }
    if (!is_found || lua_getinfo(lua, "t", &activation) == 0 || activation.istailcall == 0) return;
    // `call_first` keeps the called function as a local value.
    if (lua_getstack(lua, level + 1, &activation) == 0 || lua_checkstack(lua, 2) == 0) return;
    if (lua_getlocal(lua, &activation, 1) == nullptr) return;
    if (lua_type(lua, -1) != LUA_TFUNCTION || lua_iscfunction(lua, -1) != 0) return lua_pop(lua, 1);
    if (lua_getinfo(lua, ">S", &activation) == 0) return;
    activation.currentline = activation.linedefined;
    if (activation.linedefined <= 0) return;
    call.tail_caller.set(activation);
    call.tail_caller_end = activation.lastlinedefined;
}

// Stores the location and the frames of the error on top of the stack of `lua`, a failed coroutine. The stack still has
// the functions that were running.
void note_error(lua_State* lua, CallRecord& call) {
    lua_Debug activation;
    call.is_deep_recursion = lua_getstack(lua, deep_recursion, &activation) != 0;
    find_error_place(lua, call);
    call.error_frames = frames_of(lua, call.is_deep_recursion);
    find_caller(lua, call.error_place, call.error_caller);
    call.tail_caller.line = 0;
    if (call.error_caller.line == 0) find_tail_caller(lua, call);
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

// The fields of the table on top of the stack, in one line; "" if it can't be shown. Also "" while another table is
// being shown, because metamethods of that table may raise tables in turn.
std::string shown_fields(lua_State* lua) {
    static thread_local bool is_showing = false;
    if (std::exchange(is_showing, true)) return "";
    InspectWork work{.steps = 100, .bytes = longest_message};
    const std::string fields =
        inspect(lua, -1, {.width = longest_message, .depth = 3, .items = 20, .text = 200, .work = &work});
    is_showing = false;
    return fields.starts_with("{ ") ? ": " + fields : "";
}

std::string describe_value(lua_State* lua, std::size_t prefix) {
    switch (lua_type(lua, -1)) {
        case LUA_TSTRING:
        case LUA_TNUMBER: {
            std::size_t length = 0;
            const char* text = lua_tolstring(lua, -1, &length);
            if (prefix <= length) {
                // If an error was raised several times, its message begins with several locations.
                const std::string_view place(text, prefix);
                do {
                    text += prefix, length -= prefix;
                } while (prefix > 0 && std::string_view(text, length).starts_with(place));
            }
            if (std::string_view(text, length) == "C stack overflow")
                return "stack overflow: the recursion through metamethods, coroutines or functions of Lua's library is "
                       "too deep";
            if (length <= longest_message) return {text, length};
            return fmt::format("{}...", std::string_view(text, longest_message));
        }
        case LUA_TNIL: return "an error of value nil";
        case LUA_TTABLE: return "an error of type table" + shown_fields(lua);
        default: return fmt::format("an error of type {}", luaL_typename(lua, -1));
    }
}

CallError error_of_memory(const LuaState& state, bool is_refused, const CallRecord& call) {
    std::string message = "not enough memory";
    if (is_refused) {
        message = call.is_deep_recursion ? "stack overflow: the recursion is too deep for the script's limit of "
                                         : "not enough memory: the script reached its limit of ";
        message += shown_number(static_cast<double>(state.memory_limit()) / (1 << 20)) + " MB";
    }
    return {{message, to_place(call.error_place)}, false};
}

// Closes the variables of a failed call. An error of closing replaces the error on top of the stack of `thread`.
void close_thread(lua_State* from, lua_State* thread, CallRecord& call) {
    if (lua_status(thread) == LUA_OK) return;  // the call has not begun
    const void* const raised = lua_topointer(thread, -1);
    note_closed(thread);
    close_coroutine(thread, from);
    if (lua_topointer(thread, -1) != raised) find_error_place(thread, call);
}

int convert_to_text(lua_State* lua) {
    if (lua_type(lua, 1) == LUA_TNUMBER) lua_tostring(lua, 1);
    if (luaL_getmetafield(lua, 1, "__tostring") == LUA_TNIL) return 1;
    lua_insert(lua, 1);
    lua_call(lua, 1, 1);
    return 1;
}

// Leaves the text of an error value on top of the stack, if it has one. Returns the status of the last failed call; if
// the conversion fails, this is the status of the conversion.
int convert_error(lua_State* from, lua_State* thread, int status, CallRecord& call) {
    if (status != LUA_ERRRUN || lua_type(thread, -1) == LUA_TSTRING || lua_checkstack(thread, 2) == 0) return status;
    lua_pushvalue(thread, -1);
    lua_pushcfunction(thread, convert_to_text);
    lua_insert(thread, -2);
    int results = 0;
    const int converted = lua_resume(thread, from, 1, &results);
    if (converted == LUA_OK) {
        if (lua_type(thread, -1) != LUA_TSTRING) lua_pop(thread, 1);
        return status;
    }
    call.slice_status = LUA_OK;
    if (call.expired != 0) return converted;
    note_error(thread, call);
    close_thread(from, thread, call);
    return converted;
}

// Calls its first argument with the others. Code within this call from C can't yield, so Lua treats a script's pcall as
// outside of coroutines: when it has failed, it does not remain on the stack.
int call_first(lua_State* lua) {
    lua_pushvalue(lua, 1);
    lua_insert(lua, 1);  // stays on the stack, for the search of the caller
    lua_call(lua, lua_gettop(lua) - 2, LUA_MULTRET);
    return lua_gettop(lua) - 1;
}

// The error of `thread`, whose stack is empty afterwards. If the time limit has stopped it, no code may run in it any
// more, so it is left as it is.
CallError take_error(lua_State* from, lua_State* thread, int status, bool is_memory_refused, CallRecord& call) {
    const LuaState& state = LuaState::of(thread);
    if (call.expired != 0) {
        call.error_frames = frames_of(thread);
    } else {
        if (call.slice_status == LUA_OK) note_error(thread, call);
        close_thread(from, thread, call);
        status = convert_error(from, thread, status, call);
    }
    CallError error;
    if (call.expired != 0) {
        // The time may have ended while an error was handled, whose location is known.
        if (call.expiry_place.line == 0) call.expiry_place = call.error_place;
        if (call.expiry_place.line == 0) find_place(thread, call.expiry_place);
        error = {{"ran for more than " + shown_number(call.budget_seconds) + " s: is there an endless loop?",
                  to_place(call.expiry_place)},
                 true};
    } else if (status == LUA_ERRMEM || call.slice_status == LUA_ERRMEM) {
        error = error_of_memory(state, is_memory_refused, call);
    } else {
        // With LUA_ERRERR, the value is not the message whose location was found.
        error = {{describe_value(thread, status == LUA_ERRERR ? 0 : call.error_prefix), to_place(call.error_place)},
                 false};
        if (call.error_caller.line != 0 && lua_type(thread, -1) == LUA_TSTRING)
            error.message += fmt::format(" (called from {}:{})", call.error_caller.file, call.error_caller.line);
        if (call.tail_caller.line != 0 && lua_type(thread, -1) == LUA_TSTRING &&
            std::strcmp(call.tail_caller.file, call.error_place.file) != 0) {
            const auto lines = state.tail_calls(call.tail_caller.file, call.tail_caller.line, call.tail_caller_end);
            if (!lines.empty())
                error.message += fmt::format(" (called from {}:{})", call.tail_caller.file, fmt::join(lines, " or "));
        }
        error.message += state.hint(error);
    }
    error.frames = std::move(call.error_frames);
    if (call.seen != 0) error.used_seconds = static_cast<double>(thread_time() - call.seen) * 1e-9;
    if (call.expired == 0) lua_settop(thread, 0);
    return error;
}

// The error of a call that was abandoned inside Lua's own C code.
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
    call.closes = false;
    for (int level = last_level(coroutine); level >= 0 && !call.closes; --level) {
        if (lua_getstack(coroutine, level, &activation) == 0 || lua_getinfo(coroutine, "Sl", &activation) == 0) return;
        call.closes = *activation.what != 'C';
    }
    if (!call.closes) return;
    // The function and its source may be gone when the error is handled.
    call.closed.set(activation);
    std::memcpy(call.closed_file, activation.short_src, sizeof call.closed_file);
}

CallResult protected_call(lua_State* lua, int arguments, int results, Budget budget) {
    LuaState& state = LuaState::of(lua);
    const int function = lua_gettop(lua) - arguments;
    const auto refuse = [&](std::string message) {
        lua_settop(lua, function - 1);
        return tl::unexpected(CallError{{std::move(message)}, false});
    };
    if (state.is_lost()) return refuse("the script is lost: it had to be stopped inside Lua itself; load it again");
    if (lua_checkstack(lua, 2) == 0 || c_stack_is_used_up()) return refuse("stack overflow: calls are nested too deep");
    if (!watch_this_thread())
        return refuse(
            "scripts can't run in this thread, because they could not be stopped: the system gives it neither a timer "
            "nor a second thread");
    const std::uint64_t refusals = state.memory_refusals();
    lua_State* const thread = state.take_thread(lua, arguments + 2);
    if (thread == nullptr) return refuse("not enough memory");
    CallRecord call(thread, budget);
    forget_inner_error();
    if (call.outer == nullptr) {
        if (_setjmp(call.escape) != 0) {
            finish_escape(call);
            return tl::unexpected(lost_error(call.budget_seconds));
        }
        call.can_escape = true;
    }
    LineTrace::follow(thread);
    lua_pushcfunction(thread, call_first);
    lua_xmove(lua, thread, arguments + 1);
    int count = 0;
    const int status = lua_resume(thread, lua, arguments + 1, &count);
    if (results != LUA_MULTRET) count = results;
    std::optional<CallError> error;
    if (status != LUA_OK) {
        error = take_error(lua, thread, status, state.memory_refusals() != refusals, call);
    } else if (lua_settop(thread, count), lua_checkstack(lua, count) != 0) {
        lua_xmove(thread, lua, count);
    } else {
        lua_settop(thread, 0);
        error = CallError{{"stack overflow: too many results"}, false};
    }
    call.can_escape = false;
    call.running = lua;  // the call is over, so the timer must not interrupt its coroutine
    if (status != LUA_OK && call.expired != 0) poison(thread);
    state.give_back_thread(lua, thread);
    if (!error) return {};
    // Collects the garbage of the failed call now, because the script may not be called again for a long time.
    if (state.memory() > state.memory_limit() / 2) lua_gc(lua, LUA_GCCOLLECT);
    return tl::unexpected(std::move(*error));
}

}  // namespace nezumi
