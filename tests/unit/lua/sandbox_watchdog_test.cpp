// Scripts that try not to end.
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <thread>

#include "machine_speed.hpp"
#include "sandbox_support.hpp"

namespace nezumi {
namespace {

const std::string too_long = "ran for more than 0.1 s: is there an endless loop?";

TEST_CASE("a call returns what the function returns", "[lua][call]") {
    Box box;
    CHECK(box.run("return 1, 'two', nil, true") == "1 two nil true");
    CHECK(box.run("return") == "");
    CHECK(lua_gettop(box.lua()) == 0);
}

TEST_CASE("an endless loop is stopped, and the error has its location", "[lua][watchdog]") {
    Box box;
    CHECK(box.run_for_a_moment("while true do end") == "box.lua:1: " + too_long);
    CHECK(box.over_budget);
    CHECK(box.run_for_a_moment("\n\nrepeat until false") == "box.lua:3: " + too_long);
    CHECK(box.run_for_a_moment("::again:: goto again") == "box.lua:1: " + too_long);
    CHECK(box.run_for_a_moment("for i = 1, math.maxinteger do end") == "box.lua:1: " + too_long);
    CHECK(box.run_for_a_moment("for i = 1.0, math.huge do end") == "box.lua:1: " + too_long);
    CHECK(box.run_for_a_moment("local function f() return f() end return f()") == "box.lua:1: " + too_long);
    CHECK(box.run_for_a_moment("for _ in coroutine.running do end") == "box.lua:1: " + too_long);
    CHECK(box.run("return 'the state lives on'") == "the state lives on");
}

TEST_CASE("a script can't catch the end of its time", "[lua][watchdog]") {
    const char* const text = GENERATE(
        as<const char*>{}, "while true do pcall(function() while true do end end) end",
        "while true do xpcall(function() while true do end end, function() while true do end end) end",
        "xpcall(function() while true do end end, function() while true do end end) while true do end",
        "xpcall(error, function() while true do end end) while true do end",
        "while true do coroutine.resume(coroutine.create(function() while true do end end)) end",
        "local f = coroutine.wrap(function() while true do end end) while true do pcall(f) end",
        "local f = coroutine.wrap(function() while true do coroutine.yield() end end) while true do f() end",
        "local c = coroutine.create(function() while true do end end) coroutine.resume(c) while true do end",
        "local closer = setmetatable({}, { __close = function() while true do end end })\n"
        "while true do local x <close> = closer end",
        "local closer = setmetatable({}, { __close = function() while true do end end })\n"
        "pcall(function() local x <close> = closer; while true do end end) while true do end",
        "local closer = setmetatable({}, { __close = function() while true do end end })\n"
        "local c = coroutine.wrap(function() local x <close> = closer; while true do end end) pcall(c) while true do "
        "end",
        "local closer = setmetatable({}, { __close = function() while true do end end })\n"
        "local c = coroutine.create(function() local x <close> = closer; coroutine.yield() end)\n"
        "coroutine.resume(c) coroutine.close(c) while true do end",
        "local t = setmetatable({}, { __index = function(t, k) return t[k + 1] end }) pcall(function() return t[1] "
        "end)\n"
        "while true do pcall(function() return t[1] end) end",
        "local t = setmetatable({}, { __index = function() while true do end end }) while true do pcall(function() "
        "return t.x end) end",
        "table.sort({3, 2, 1}, function() while true do end end)",
        "while true do pcall(table.sort, {3, 2, 1}, function() while true do end end) end",
        "(('x'):rep(100)):gsub('x', function() while true do end end)",
        "while true do pcall(string.gsub, 'x', 'x', function() while true do end end) end",
        "while true do pcall(tostring, setmetatable({}, { __tostring = function() while true do end end })) end",
        "while true do pcall(error, setmetatable({}, { __tostring = function() while true do end end })) end",
        "error(setmetatable({}, { __tostring = function() while true do end end }))",
        "while true do pcall(pcall, pcall, function() while true do end end) end",
        "local function f() pcall(f) f() end f()",
        "local function again() return pcall(again) end while true do again() end",
        "local s = setmetatable({}, { __eq = function() while true do end end }) return s == setmetatable({}, "
        "getmetatable(s))",
        "for _ in pairs(setmetatable({}, { __pairs = function() return function() return 1 end end })) do end",
        "for _ in pairs(setmetatable({}, { __pairs = function() while true do end end })) do end",
        "local t = {} while true do t[#t % 1000 + 1] = {} end",
        "while true do local ok = select(2, pcall(string.rep, 'x', 1 << 40)) end",
        "coroutine.wrap(function() local f f = function() coroutine.wrap(f)() end while true do pcall(f) end end)()");
    CAPTURE(text);
    Box box;
    const std::int64_t began = thread_time();
    const std::string outcome = box.run_for_a_moment(text);
    CHECK(outcome.find(too_long) != std::string::npos);
    CHECK(box.over_budget);
    CHECK(static_cast<double>(thread_time() - began) * 1e-9 < 2 * slowness());
    CHECK(box.run("return 'the state lives on'") == "the state lives on");
}

TEST_CASE("an endless loop far down in a recursion is stopped", "[lua][watchdog]") {
    const std::string closer = "local c = setmetatable({}, { __close = function() while true do end end }) ";
    // Lua gets half a budget to close all these variables, on a slow machine too.
    const std::string closed = fmt::format("{:.0f}", 100'000 / slowness());
    const std::string text = GENERATE_COPY(
        as<std::string>{}, "local function f(n) if n == 0 then while true do end end return 1 + f(n - 1) end f(150000)",
        "local function f(n) if n == 0 then while true do end end return 1 + f(n - 1) end pcall(f, 150000) f(150000)",
        closer +
            "local function f(n) local x <close> = c if n == 0 then while true do end end return 1 + f(n - 1) end "
            "pcall(f, " +
            closed + ") while true do end",
        closer +
            "local function f(n) local x <close> = c if n == 0 then while true do end end return 1 + f(n - 1) end "
            "coroutine.resume(coroutine.create(f), " +
            closed + ")",
        closer +
            "local function f(n) local x <close> = c if n == 0 then coroutine.yield() end return 1 + f(n - 1) end "
            "local co = coroutine.create(f) coroutine.resume(co, " +
            closed + ") coroutine.close(co)");
    CAPTURE(text);
    Box box;
    const std::int64_t began = thread_time();
    CHECK(box.run_for_a_moment(text) == "box.lua:1: " + too_long);
    CHECK(static_cast<double>(thread_time() - began) * 1e-9 < 2 * slowness());
}

TEST_CASE("a coroutine that was stopped stays stopped in later calls", "[lua][watchdog]") {
    Box box;
    CHECK(box.run_for_a_moment("kept = coroutine.create(function()\n"
                               "  local x <close> = setmetatable({}, { __close = function() while true do end end })\n"
                               "  while true do end\n"
                               "end)\n"
                               "coroutine.resume(kept)") == "box.lua:3: " + too_long);
    CHECK(box.run("return coroutine.status(kept)") == "dead");
    CHECK(box.run("return coroutine.resume(kept)") == "false cannot resume dead coroutine");
    CHECK(box.run("return coroutine.close(kept)") == "false the coroutine ran for too long");
    CHECK(box.run_for_a_moment("kept = coroutine.wrap(function()\n"
                               "  local x <close> = setmetatable({}, { __close = function() while true do end end })\n"
                               "  while true do end\n"
                               "end)\n"
                               "kept()") == "box.lua:3: " + too_long);
    CHECK(box.run("return pcall(kept)") == "false cannot resume dead coroutine");
}

TEST_CASE("a call within its time is never stopped", "[lua][watchdog]") {
    Box box;
    for (int i = 0; i < 200; ++i)
        CHECK(box.run("local n = 0 for i = 1, 100000 do n = n + i end return n") == "5000050000");
}

TEST_CASE("the time limit is CPU time of the thread, and is in the message", "[lua][watchdog]") {
    Box box;
    const std::int64_t began = thread_time();
    CHECK(box.run("while true do end", Budget{0.3}) == "box.lua:1: ran for more than 0.3 s: is there an endless loop?");
    const double used = static_cast<double>(thread_time() - began) * 1e-9;
    CHECK(used > 0.29);
    CHECK(used < 0.3 + 0.3 * slowness());
}

TEST_CASE("states in several threads have separate time limits", "[lua][watchdog]") {
    std::vector<std::thread> threads;
    std::vector<std::string> outcomes(6);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        threads.emplace_back([i, &outcomes] {
            Box box;
            for (int round = 0; round < 3; ++round) {
                outcomes[i] = box.run_for_a_moment(
                    i % 2 == 0 ? "while true do end" : "local n = 0 for i = 1, 1000 do n = n + i end return n");
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        CHECK(outcomes[i] == (i % 2 == 0 ? "box.lua:1: " + too_long : "500500"));
    }
}

// Calls the global function `inner` of the state in the upvalue, within 0.05 s, and returns whether that went well.
int call_other(lua_State* lua) {
    auto* other = static_cast<lua_State*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const int top = lua_gettop(other);
    lua_getglobal(other, "inner");
    const bool well = protected_call(other, 0, 0, Budget{0.05}).has_value();
    lua_settop(other, top);
    lua_pushboolean(lua, well ? 1 : 0);
    return 1;
}

void give_call(Box& box, lua_State* other) {
    lua_pushlightuserdata(box.lua(), other);
    lua_pushcclosure(box.lua(), call_other, 1);
    lua_setglobal(box.lua(), "call_other");
}

TEST_CASE("scripts are also stopped if the system provides no timer", "[lua][watchdog]") {
    const char* const text = GENERATE(
        as<const char*>{}, "while true do end", "while true do pcall(function() while true do end end) end",
        "coroutine.wrap(function() while true do end end)()",
        "local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = function() while "
        "true do end end }) coroutine.yield() end) coroutine.resume(c) coroutine.close(c)");
    CAPTURE(text);
    rlimit timers{};
    REQUIRE(getrlimit(RLIMIT_SIGPENDING, &timers) == 0);
    std::string stopped, lives_on, inner;
    std::thread([&] {
        const rlimit none{0, timers.rlim_max};  // each timer needs a signal that may wait
        setrlimit(RLIMIT_SIGPENDING, &none);
        Box box;
        lives_on = box.run("return 'the state lives on'");
        setrlimit(RLIMIT_SIGPENDING, &timers);
        stopped = box.run_for_a_moment(text);
        inner = box.run("return coroutine.wrap(function() return 'in' end)()");
    }).join();
    CHECK(stopped == "box.lua:1: " + too_long);
    CHECK(lives_on == "the state lives on");
    CHECK(inner == "in");
}

TEST_CASE("without a timer, work in C functions also counts", "[lua][watchdog]") {
    rlimit timers{};
    REQUIRE(getrlimit(RLIMIT_SIGPENDING, &timers) == 0);
    std::string outcome;
    double used = 0;
    std::thread([&] {
        const rlimit none{0, timers.rlim_max};
        setrlimit(RLIMIT_SIGPENDING, &none);
        Box box;
        REQUIRE(box.run("t = {} for i = 1, 300000 do t[i] = 'x' end") == "");
        const std::int64_t began = thread_time();
        outcome = box.run_for_a_moment("for i = 1, 1000 do table.concat(t) end");
        used = static_cast<double>(thread_time() - began) * 1e-9;
        setrlimit(RLIMIT_SIGPENDING, &timers);
    }).join();
    CHECK(outcome == "box.lua:1: " + too_long);
    CHECK(used < 0.5 * slowness());
}

TEST_CASE("a thread without a timer is not woken while it is idle", "[lua][watchdog]") {
    rlimit timers{};
    REQUIRE(getrlimit(RLIMIT_SIGPENDING, &timers) == 0);
    int interrupted = -1;
    std::thread([&] {
        const rlimit none{0, timers.rlim_max};
        setrlimit(RLIMIT_SIGPENDING, &none);
        Box box;
        box.run("return 1");
        setrlimit(RLIMIT_SIGPENDING, &timers);
        interrupted = poll(nullptr, 0, 100);
    }).join();
    CHECK(interrupted == 0);
}

TEST_CASE("an inner call has its own time limit, within that of the outer call", "[lua][watchdog]") {
    Box outer;
    Box inner;
    const bool same_state = GENERATE(false, true);
    Box& target = same_state ? outer : inner;
    give_call(outer, target.lua());
    target.run("function inner() while true do end end");
    CHECK(outer.run("return call_other(), 'goes on'", Budget{0.5}) == "false goes on");
    // Each inner call ends by its own budget, and all of them together by the outer one's.
    CHECK(outer.run("while true do call_other() end", Budget{0.2}) ==
          "box.lua:1: ran for more than 0.2 s: is there an endless loop?");
    CHECK(outer.over_budget);
    target.run("function inner() end");
    CHECK(outer.run("return call_other()") == "true");
}

TEST_CASE("endless nesting of calls through C functions is an error", "[lua][call]") {
    Box box;
    give_call(box, box.lua());
    CHECK(
        box.run(
            "local most = 0 function inner() most = most + 1 return call_other() end call_other() return most < 10000",
            Budget{2.0}) == "true");
    Box other;
    give_call(box, other.lua());
    give_call(other, box.lua());
    for (Box* each : {&box, &other}) each->run("n = 0 function inner() n = n + 1 return call_other() end");
    CHECK(box.run("inner() return n > 10", Budget{5.0}) == "true");
}

// A weak table made so after setmetatable has looked, with a chain of keys that the collector follows link by link.
// Made without a limit of time; `bomb` then takes longer than any.
const char* const collector_bomb =
    "local m = {} local t = setmetatable({}, m) local n, keys = 60000, {} for i = 1, n do keys[i] = {} end "
    "for i = n, 2, -1 do local j = math.random(i) keys[i], keys[j] = keys[j], keys[i] end "
    "for i = 1, n - 1 do t[keys[i]] = keys[i + 1] end local first = keys[1] keys = nil "
    "function bomb() m.__mode = 'k' local junk while true do junk = { first, t } end end ";

TEST_CASE("endless work in the garbage collector is abandoned, and its state is lost", "[lua][watchdog]") {
    Box box;
    Box bystander;
    const std::string lost =
        "ran for more than 0.1 s inside Lua itself, where it could not be stopped: the script is lost, load it again";
    const bool nested = GENERATE(false, true);
    if (nested) {
        give_call(bystander, box.lua());
        box.run(collector_bomb + std::string("inner = bomb"));
        CHECK(bystander.run_for_a_moment("call_other()") == lost);
        CHECK(bystander.over_budget);
        CHECK(bystander.state->is_lost());
    } else {
        box.run(collector_bomb);
        CHECK(box.run_for_a_moment("bomb()") == lost);
        CHECK(box.over_budget);
        CHECK(bystander.run("return 'goes on'") == "goes on");
    }
    CHECK(box.state->is_lost());
    CHECK(box.run("return 1") == "the script is lost: it had to be stopped inside Lua itself; load it again");
    lua_getglobal(box.lua(), "anything");
    lua_settop(box.lua(), 0);
    CHECK(current_call == nullptr);
    Box next;
    CHECK(next.run_for_a_moment("while true do end") == "box.lua:1: " + too_long);
}

TEST_CASE("Lua's own C code is abandoned after one and a half times the limit", "[lua][watchdog]") {
    Box box;
    // What calls a table is looked for in a circle, which was closed after setmetatable has looked.
    REQUIRE(box.run("local k = setmetatable({}, {}) getmetatable(k).__call = k "
                    "function bomb() pcall(function() return k() end) end") == "");
    const std::int64_t began = thread_time();
    CHECK(box.run("bomb()", paced_budget).find("ran for more than 0.1 s inside Lua itself") == 0);
    const double used = static_cast<double>(thread_time() - began) * 1e-9;
    CHECK(used > 0.14);
    CHECK(used < 0.3);
}

TEST_CASE("the timer does not change system calls and errno of the program", "[lua][watchdog]") {
    Box box;
    box.run("return 1");
    errno = 42;
    const std::int64_t began = thread_time();
    while (thread_time() - began < 50'000'000) {
    }
    CHECK(errno == 42);
}

}  // namespace
}  // namespace nezumi
