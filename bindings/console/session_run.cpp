// Runs an input in Lua: in one call, or, if the worker has no thread, in slices between which the input waits for
// ticks.
#include <fmt/format.h>

#include <utility>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/input_text.hpp"
#include "bindings/console/session_parts.hpp"
#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/inspect.hpp"
#include "bindings/lua/sandbox/slices.hpp"
#include "engine/live/live_text.hpp"

namespace nezumi {
namespace {

constexpr Budget input_budget{5.0};
constexpr const char* results_of_input = "nezumi.results";  // in the registry

// An error of an input with one line needs no location. With several lines, the line number replaces the name of the
// input.
std::string error_text(const Error& error, std::string_view input) {
    if (error.place.file != input_name || error.place.line <= 0) return describe(error);
    if (input.find('\n') == std::string_view::npos) return error.message;
    return fmt::format("line {}: {}", error.place.line, error.message);
}

// Shows all values above `base`.
void show_results(Session::Parts& parts, lua_State* L, int base) {
    const int count = lua_gettop(L);
    if (count == base) return;
    std::vector<std::string> texts;
    bool several_lines = false;
    InspectWork work;
    for (int i = base + 1; i <= count; ++i) {
        const ConsoleCommand* command = command_at(L, i);
        texts.push_back(command != nullptr ? fmt::format("{}: {}", command->usage, command->help)
                                           : inspect(L, i, {.work = &work}));
        several_lines = several_lines || texts.back().find('\n') != std::string::npos;
    }
    parts.show(fmt::format("{}", fmt::join(texts, several_lines ? "\n" : "\t")));
}

// Shows the values above the index `base` and pops them. If a command among them still needs its table, shows an error
// instead and returns false.
bool take_results(Session::Parts& parts, lua_State* L, int base) {
    for (int i = base + 1; i <= lua_gettop(L); ++i) {
        const std::string begun = waiting_command_at(L, i);
        if (begun.empty()) continue;
        lua_settop(L, base);
        parts.show_error(fmt::format("expected a table after the name: {} {{ ... }}", begun));
        return false;
    }
    show_results(parts, L, base);
    lua_settop(L, base);
    return true;
}

// Stores the results of the input in the registry, because the results of a coroutine would be lost.
int keep_results(lua_State* L, int /*status*/, lua_KContext /*context*/) {
    const int count = lua_gettop(L);
    luaL_checkstack(L, 2, nullptr);
    lua_createtable(L, count, 0);
    lua_insert(L, 1);
    for (int i = count; i > 0; --i) lua_rawseti(L, 1, i);
    lua_setfield(L, LUA_REGISTRYINDEX, results_of_input);
    return 0;
}

// The function of the coroutine: calls the compiled input, which is its upvalue.
int call_input(lua_State* L) {
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_callk(L, 0, LUA_MULTRET, 0, keep_results);
    return keep_results(L, LUA_OK, 0);
}

// Takes the compiled input from the stack, and returns a coroutine that calls it.
int make_coroutine(lua_State* L) {
    lua_State* const coroutine = lua_newthread(L);
    lua_insert(L, 1);
    lua_pushcclosure(L, call_input, 1);
    lua_xmove(L, coroutine, 1);
    return 1;
}

void unpack_results(lua_State* L) {
    if (lua_getfield(L, LUA_REGISTRYINDEX, results_of_input) != LUA_TTABLE) return lua_pop(L, 1);
    const auto count = static_cast<int>(lua_rawlen(L, -1));
    const int table = lua_gettop(L);
    if (lua_checkstack(L, count + 1) != 0) {
        for (int i = 1; i <= count; ++i) lua_rawgeti(L, table, i);
    }
    lua_remove(L, table);
}

// Runs the next slice of the coroutine on top of the stack. Calls `done` when the coroutine has ended.
void go_on(Session::Parts& parts, const std::string& input, const std::function<void(bool)>& done) {
    lua_State* const L = parts.state->lua();
    lua_State* const coroutine = lua_tothread(L, -1);
    const int base = lua_gettop(L) - 1;
    SliceEnd end = SliceEnd::failed;
    const auto called = protect(L, input_budget, [&end, coroutine](lua_State* inside) -> int {
        end = run_slice(inside, coroutine);
        return end == SliceEnd::failed ? lua_error(inside) : 0;
    });
    if (!called) {
        lua_settop(L, base);
        parts.show_error(error_text(called.error(), input));
        return done(false);
    }
    if (end == SliceEnd::paused) {
        parts.paused_at = base;
        return parts.worker.start_again([&parts, input, done] { go_on(parts, input, done); });
    }
    lua_settop(L, base);
    unpack_results(L);
    done(take_results(parts, L, base));
}

}  // namespace

void Session::Parts::run(const std::string& input, std::function<void(bool)> done) {
    const auto refuse = [&](const Error& error) {
        show_error(error_text(error, input));
        done(false);
    };
    const auto chunk = compile_input(input);
    if (!chunk) return refuse(chunk.error());
    lua_State* const L = state->lua();
    if (!Worker::has_thread) {
        if (paused_at) lua_settop(L, *paused_at);  // an interrupted input has left its coroutine
        paused_at.reset();
        waits = nullptr;
    }
    const int base = lua_gettop(L);
    if (auto loaded = load_chunk(L, *chunk); !loaded) return refuse(loaded.error());
    if (Worker::has_thread) {
        if (auto called = protected_call(L, 0, LUA_MULTRET, input_budget); !called) return refuse(called.error());
        return done(take_results(*this, L, base));
    }
    lua_pushcfunction(L, make_coroutine);
    lua_insert(L, -2);
    if (auto made = protected_call(L, 1, 1, input_budget); !made) return refuse(made.error());
    go_on(*this, input, done);
}

}  // namespace nezumi
