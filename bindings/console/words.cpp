// One C function serves all words; what it finds wrong becomes a Lua error once nothing is left to destroy.
#include "bindings/console/words.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi {
namespace {

enum class Outcome : unsigned char { done, number, wait, failed };

Outcome run_word(lua_State* L, Session::Parts& parts, const Word& word) {
    const WordArguments arguments{L, lua_gettop(L)};
    Expected<WordEnd> end;
    if (arguments.count > word.most) {
        end = failure(
            fmt::format("expected at most {} argument{}: {}", word.most, word.most == 1 ? "" : "s", word.usage));
    } else {
        end = word.run(parts, arguments);
    }
    if (!end) {
        parts.raised = fmt::format("{}: {}", word.name, describe(end.error()));
        return Outcome::failed;
    }
    if (*end == WordEnd::number) return Outcome::number;
    return *end == WordEnd::wait ? Outcome::wait : Outcome::done;
}

Session::Parts& parts_of(lua_State* L) { return *static_cast<Session::Parts*>(lua_touserdata(L, lua_upvalueindex(1))); }

int raise(lua_State* L, const Session::Parts& parts) {
    luaL_where(L, 1);
    lua_pushlstring(L, parts.raised.data(), parts.raised.size());
    lua_concat(L, 2);
    return lua_error(L);
}

int refuse_wait(lua_State* L) {
    return luaL_error(L, "can't wait for time to pass here: call it from the input itself");
}

// The input goes on. It was not left when a coroutine within it could be left, and not what called that.
int finish_wait(lua_State* L, int, lua_KContext) {
    Session::Parts& parts = parts_of(L);
    if (!std::exchange(parts.waiting, false)) return 0;
    parts.clock.pause();
    return refuse_wait(L);
}

int call_word(lua_State* L) {
    Session::Parts& parts = parts_of(L);
    const auto number = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(2)));
    switch (run_word(L, parts, console_words()[number])) {
        case Outcome::done: return 0;
        case Outcome::number: lua_pushnumber(L, parts.number); return 1;
        case Outcome::failed: return raise(L, parts);
        case Outcome::wait: break;
    }
    if (lua_isyieldable(L) == 0) return refuse_wait(L);
    parts.waiting = true;
    parts.clock.advance(parts.ticks);
    current_call->slice_over = true;  // also out of the input's own coroutines
    return lua_yieldk(L, 0, 0, finish_wait);
}

}  // namespace

Expected<std::string> WordArguments::text(int index, std::string_view what) const {
    if (index <= count && lua_type(lua, index) == LUA_TSTRING) {
        std::size_t length = 0;
        const char* text = lua_tolstring(lua, index, &length);
        return std::string(text, length);
    }
    return failure(fmt::format("expected {}, got {}", what, has(index) ? luaL_typename(lua, index) : "nothing"));
}

Expected<double> WordArguments::number(int index, std::string_view what) const {
    if (index <= count && lua_type(lua, index) == LUA_TNUMBER) return lua_tonumber(lua, index);
    return failure(fmt::format("expected {}, got {}", what, has(index) ? luaL_typename(lua, index) : "nothing"));
}

const std::vector<Word>& console_words() {
    static const std::vector<Word> words{
        {"ls", "ls() or ls(component)", "lists what there is, how it is wired and what is held", 1, word_ls},
        {"find", "find \"vel\"", "lists ports, parameters and commands whose name or description has this", 1,
         word_find},
        {"watch", "watch(port)", "shows a port's value whenever it changes", 1, word_watch},
        {"unwatch", "unwatch(port) or unwatch()", "ends one watch, or all", 1, word_unwatch},
        {"plot", "plot(port, seconds)", "draws what a port carried in the last seconds", 2, word_plot},
        {"inject", "inject(port, value)", "sends one message to a port, as from a connection", 2, nullptr},
        {"hold", "hold(port, value)", "sends this value every tick; nothing else gets through", 3, nullptr},
        {"release", "release(port)", "ends hold", 1, nullptr},
        {"connect", "connect(from, to)", "connects an out-port to an in-port", 2, word_connect},
        {"disconnect", "disconnect(from, to) or disconnect(port)", "ends one connection, or all of a port", 2,
         word_disconnect},
        {"drive", "drive \"stick\"", "drives with the arrow keys, until Esc", 1, word_drive},
        {"teleport", "teleport(\"target\", { x = 1 })", "carries a marker, or a robot, elsewhere", 2, word_teleport},
        {"stop", "stop()", "emergency stop: robots brake and ignore commands until rearm()", 0, word_stop},
        {"rearm", "rearm()", "lets robots that stand obey again what comes from now on", 0, word_rearm},
        {"pause", "pause()", "stops time; run() lets it go on", 0, word_pause},
        {"step", "step(n)", "lets n ticks pass, then pauses", 1, word_step},
        {"run", "run(seconds) or run()", "lets so much time pass, then pauses; run() goes on without end", 1, word_run},
        {"speed", "speed(factor)", "how fast time passes: 1 as on the clock, \"max\" as fast as possible", 1,
         word_speed},
        {"restart", "restart()", "reads the system file again and begins anew", 0, word_restart},
        {"reload", "reload()", "loads every script that has changed", 0, word_reload},
        {"rollback", "rollback() or rollback(component)", "goes back to the version before", 1, word_rollback},
        {"errors", "errors()", "lists what is in ERROR, and the last warnings and errors", 0, word_errors},
        {"save", "save \"system.lua\"", "writes the present wiring and configuration as a system file", 1, word_save},
        {"now", "now()", "shows the simulated time", 0, word_now},
        {"print", "print(...)", "prints values", 250, word_print},
        {"help", "help() or help \"step\"", "explains the words", 1, word_help},
        {"quit", "quit()", "ends the run", 0, word_quit},
        {"exit", "exit()", "is quit()", 0, word_quit},
    };
    return words;
}

void add_words(lua_State* L, Session::Parts& parts) {
    luaL_checkstack(L, 6, nullptr);
    lua_Integer number = 0;
    for (const Word& word : console_words()) {
        if (word.run != nullptr) {
            lua_pushlightuserdata(L, &parts);
            lua_pushinteger(L, number);
            lua_pushcclosure(L, call_word, 2);
            lua_setfield(L, -2, word.name);
        }
        ++number;
    }
}

const Word* word_at(lua_State* L, int index) {
    if (lua_tocfunction(L, index) != call_word || lua_getupvalue(L, index, 2) == nullptr) return nullptr;
    const auto number = static_cast<std::size_t>(lua_tointeger(L, -1));
    lua_pop(L, 1);
    return &console_words()[number];
}

}  // namespace nezumi
