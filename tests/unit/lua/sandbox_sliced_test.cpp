// Calls that run in slices: nothing typed at a console makes a tick late.
#include <catch2/catch.hpp>
#include <chrono>

#include "bindings/lua/sandbox/sliced_call.hpp"
#include "machine_speed.hpp"
#include "sandbox_support.hpp"

namespace nezumi {
namespace {

using Progress = SlicedCall::Progress;
using std::chrono::microseconds;
using std::chrono::milliseconds;

struct Outcome {
    std::string text;
    int slices = 0;
    double longest = 0;  ///< [s] of CPU time
};

Outcome run_sliced(Box& box, std::string_view text, Budget total = Budget{5.0},
                   microseconds slice = microseconds(1000)) {
    lua_settop(box.lua(), 0);
    REQUIRE(load_chunk(box.lua(), compile(text, "line").value()));
    const auto call = SlicedCall::start(*box.state, 0, total).value();
    CHECK(lua_gettop(box.lua()) == 0);
    Outcome outcome;
    Progress progress = Progress::running;
    while (progress == Progress::running) {
        const std::int64_t began = thread_time();
        progress = call->advance(slice);
        outcome.longest = std::max(outcome.longest, static_cast<double>(thread_time() - began) * 1e-9);
        ++outcome.slices;
        REQUIRE(outcome.slices < 100'000);
    }
    if (progress == Progress::failed) {
        outcome.text = describe(call->error());
    } else {
        const int count = lua_gettop(call->results());
        for (int i = 1; i <= count; ++i) {
            outcome.text += (i > 1 ? " " : "") + std::string(luaL_tolstring(call->results(), i, nullptr));
            lua_pop(call->results(), 1);
        }
    }
    return outcome;
}

const std::string sum = "local n = 0 for i = 1, 2000000 do n = n + i end ";

TEST_CASE("a short line needs one slice, a long one many short ones", "[lua][sliced]") {
    Box box;
    const Outcome quick = run_sliced(box, "return 42");
    CHECK(quick.text == "42");
    CHECK(quick.slices == 1);
    const Outcome slow = run_sliced(box, sum + "return n");
    CHECK(slow.text == "2000001000000");
    CHECK(slow.slices > 3);
}

TEST_CASE("a line is sliced wherever it is", "[lua][sliced][watchdog]") {
    const char* const text = GENERATE(
        as<const char*>{}, "return select(2, pcall(work))", "return select(2, xpcall(work, print))",
        "return select(2, pcall(pcall, pcall, work)) and work()", "return coroutine.wrap(work)()",
        "return select(2, coroutine.resume(coroutine.create(work)))",
        "local c = coroutine.wrap(function() coroutine.yield(work()) end) return c()",
        "return coroutine.wrap(function() return coroutine.wrap(function() return select(2, pcall(work)) end)() end)()",
        "local t = setmetatable({}, { __index = function() return work() end }) return t.x",
        "local t = setmetatable({}, { __add = function() return work() end }) return t + 1",
        "local n do local x <close> = setmetatable({}, { __close = function() n = work() end }) end return n",
        "for _, n in pairs(setmetatable({}, { __pairs = function() return next, { work() } end })) do return n end",
        "kept = kept or coroutine.wrap(function() while true do coroutine.yield(work()) end end) return kept()");
    CAPTURE(text);
    Box box;
    box.run("function work() " + sum + "return n end");
    for (int round = 0; round < 2; ++round) {
        const Outcome outcome = run_sliced(box, text);
        CHECK(outcome.text == "2000001000000");
        CHECK(outcome.slices > 3);
    }
}

TEST_CASE("where Lua can't yield, a slice goes on until it can", "[lua][sliced]") {
    const char* const text = GENERATE(
        as<const char*>{}, "local n table.sort({ 1, 2 }, function() n = work() return false end) work() return n",
        "local n = ('x'):gsub('x', function() work() return 'done' end) work() return 2000001000000",
        "local n table.sort({ 1, 2 }, function() n = coroutine.wrap(work)() return false end) work() return n",
        "local s = tostring(setmetatable({}, { __tostring = function() return ('%d'):format(work()) end })) work() "
        "return s");
    CAPTURE(text);
    Box box;
    box.run("function work() " + sum + "return n end");
    const Outcome outcome = run_sliced(box, text);
    CHECK(outcome.text == "2000001000000");
    CHECK(outcome.slices > 3);
}

TEST_CASE("an endless line ends by its total time, whatever it does", "[lua][sliced][watchdog]") {
    const char* const text = GENERATE(
        as<const char*>{}, "while true do end", "while true do pcall(function() while true do end end) end",
        "coroutine.wrap(function() while true do end end)()", "table.sort({ 1, 2 }, function() while true do end end)",
        "while true do pcall(table.sort, { 1, 2 }, function() while true do end end) end",
        "local function f() while true do pcall(f) end end f()",
        "local x <close> = setmetatable({}, { __close = function() while true do end end }) while true do end");
    CAPTURE(text);
    Box box;
    const std::int64_t began = thread_time();
    CHECK(run_sliced(box, text, Budget{0.2}).text == "line:1: ran for more than 0.2 s: is there an endless loop?");
    CHECK(static_cast<double>(thread_time() - began) * 1e-9 < 0.2 + 0.3 * slowness());
    CHECK(box.run("return 'the state lives on'") == "the state lives on");
}

TEST_CASE("a slice takes about its time", "[lua][sliced][wallclock]") {
    Box box;
    CHECK(run_sliced(box, sum + "return n").longest < 0.003);
}

TEST_CASE("a sliced line looks to itself as if it were none", "[lua][sliced][watchdog]") {
    Box box;
    CHECK(run_sliced(box, "local _, main = coroutine.running() return main, coroutine.isyieldable()").text ==
          "true false");
    CHECK(run_sliced(box, "coroutine.yield(1)").text == "line:1: attempt to yield from outside a coroutine");
    CHECK(run_sliced(box, "return pcall(coroutine.yield)").text == "false attempt to yield from outside a coroutine");
    CHECK(run_sliced(box, "return coroutine.wrap(function() coroutine.yield('in') end)()").text == "in");
    CHECK(run_sliced(box, "return 1, nil, 'x'").text == "1 nil x");
    CHECK(run_sliced(box, "\nerror('stop')").text == "line:2: stop");
    CHECK(run_sliced(box, "error({})").text == "line:1: an error of type table");
    CHECK(run_sliced(box, "error(setmetatable({}, { __tostring = function() return 'mine' end }))").text ==
          "line:1: mine");
    CHECK(run_sliced(box, "local t = {} while true do t[#t + 1] = {} end").text ==
          "line:1: not enough memory: the script reached its limit of 64 MB");
    CHECK(run_sliced(box, "local function f() return 1 + f() end f()").text.find("stack overflow") !=
          std::string::npos);
    CHECK(run_sliced(box, "return ('a'):rep(3000):find('.-.-.-b')").text ==
          "line:1: pattern too complex: it takes too many steps");
}

TEST_CASE("the state takes other calls between two slices", "[lua][sliced][watchdog]") {
    Box box;
    box.run("count = 0");
    REQUIRE(load_chunk(box.lua(), compile("for i = 1, 3000000 do count = count + 1 end return count", "line").value()));
    const auto call = SlicedCall::start(*box.state, 0, Budget{5.0}).value();
    int others = 0;
    while (call->advance(milliseconds(1)) == Progress::running) {
        CHECK(box.run("return coroutine.wrap(function() return count > 0 end)()") == "true");
        CHECK(box.run("while true do end", Budget{0.01}).find("ran for more than 0.01 s") != std::string::npos);
        if (++others == 5) break;
    }
    while (call->advance(milliseconds(10)) == Progress::running) {
    }
    CHECK(lua_tointeger(call->results(), 1) == 3000000);
    CHECK(call->used_seconds() > 0.001);
}

TEST_CASE("a sliced call may be given up at any time", "[lua][sliced][watchdog]") {
    Box box;
    for (int i = 0; i < 20; ++i) {
        load_chunk(box.lua(), compile("local t = {} while true do t[#t + 1] = {} end", "line").value());
        const auto call = SlicedCall::start(*box.state, 0, Budget{5.0}).value();
        call->advance(microseconds(200));
    }
    lua_gc(box.lua(), LUA_GCCOLLECT);
    CHECK(box.state->memory() < 30'000);
}

TEST_CASE("a sliced call gets its arguments", "[lua][sliced]") {
    Box box;
    load_chunk(box.lua(), compile("local a, b = ... return b, a, select('#', ...)", "line").value());
    lua_pushinteger(box.lua(), 1);
    lua_pushinteger(box.lua(), 2);
    const auto call = SlicedCall::start(*box.state, 2, Budget{5.0}).value();
    REQUIRE(call->advance(milliseconds(1)) == Progress::finished);
    CHECK(lua_gettop(call->results()) == 3);
    CHECK(lua_tointeger(call->results(), 1) == 2);
    CHECK(lua_tointeger(call->results(), 3) == 2);
}

}  // namespace
}  // namespace nezumi
