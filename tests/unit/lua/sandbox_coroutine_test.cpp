// Coroutines do what Lua's do, although the watchdog follows them.
#include <catch2/catch.hpp>

#include "sandbox_support.hpp"

namespace nezumi {
namespace {

TEST_CASE("values go in and out of coroutines", "[lua][coroutine]") {
    Box box;
    CHECK(
        box.run(
            "local c = coroutine.create(function(a, b) local d = coroutine.yield(a + b) local e, f = coroutine.yield(d "
            "* 2) return e .. f end) "
            "local out = {} for _, x in ipairs { { 1, 2 }, { 10 }, { 'x', 'y' }, {} } do "
            "local ok, v = coroutine.resume(c, table.unpack(x)) out[#out + 1] = tostring(ok) .. ' ' .. tostring(v) end "
            "return table.concat(out, ', '), coroutine.status(c)") ==
        "true 3, true 20, true xy, false cannot resume dead coroutine dead");
    CHECK(box.run("local c = coroutine.wrap(function(...) return select('#', ...), ... end) return c(nil, nil)") ==
          "2 nil nil");
    CHECK(box.run("local n = 0 for v in coroutine.wrap(function() for i = 1, 10 do coroutine.yield(i) end end) do n = "
                  "n + v end return n") == "55");
    CHECK(box.run("local c = coroutine.wrap(function() end) c() c()") == "box.lua:1: cannot resume dead coroutine");
    CHECK(box.run("return coroutine.resume(coroutine.create(error), 'x', 0)") == "false x");
    CHECK(box.run("return coroutine.resume(coroutine.create(error), { })") == "false table");
    CHECK(box.run("coroutine.resume(1)") == "box.lua:1: bad argument #1 to 'resume' (coroutine expected, got number)");
    CHECK(box.run("coroutine.create(1)") == "box.lua:1: bad argument #1 to 'create' (function expected, got number)");
    CHECK(box.run("coroutine.wrap()") == "box.lua:1: bad argument #1 to 'wrap' (function expected, got no value)");
    CHECK(box.run("coroutine.yield()") == "box.lua:1: attempt to yield from outside a coroutine");
    CHECK(box.run("return select('#', coroutine.resume(coroutine.create(function() return table.unpack({}, 1, 100000) "
                  "end)))") == "100001");
}

TEST_CASE("a coroutine may yield wherever Lua itself may", "[lua][coroutine]") {
    Box box;
    box.run("function step() return coroutine.yield('out') end");
    const char* const body = GENERATE(
        as<const char*>{}, "return select(2, pcall(step))", "return select(2, xpcall(step, print))",
        "return select(4, pcall(pcall, pcall, step))",
        "return setmetatable({}, { __index = function() return step() end }).x",
        "return setmetatable({}, { __add = function() return step() end }) + 1",
        "local n do local x <close> = setmetatable({}, { __close = function() n = step() end }) end return n",
        "for _, n in pairs(setmetatable({}, { __pairs = function() return next, { step() } end })) do return n end");
    CAPTURE(body);
    CHECK(box.run("local c = coroutine.wrap(function() " + std::string(body) + " end) return c(), c(2)") == "out 2");
    CHECK(box.run("return pcall(coroutine.yield)") == "false attempt to yield from outside a coroutine");
    CHECK(box.run("return coroutine.wrap(function() return pcall(table.sort, { 1, 2 }, step) end)()") ==
          "false attempt to yield across a C-call boundary");
}

TEST_CASE("a coroutine knows its status", "[lua][coroutine]") {
    Box box;
    CHECK(box.run("local c c = coroutine.create(function() coroutine.yield(coroutine.status(c)) end) local before = "
                  "coroutine.status(c) "
                  "local _, inside = coroutine.resume(c) local after = coroutine.status(c) coroutine.resume(c) return "
                  "before, inside, after, coroutine.status(c)") == "suspended running suspended dead");
    CHECK(box.run("local c c = coroutine.create(function() return coroutine.wrap(function() return "
                  "coroutine.status(c), coroutine.resume(c) end)() end) "
                  "return coroutine.resume(c)") == "true normal false cannot resume non-suspended coroutine");
    CHECK(box.run("local c c = coroutine.wrap(function() return pcall(c) end) return c()") ==
          "false cannot resume non-suspended coroutine");
    CHECK(
        box.run("local main, is_main = coroutine.running() local inner, is_inner = coroutine.wrap(coroutine.running)() "
                "return is_main, is_inner, main == inner, coroutine.isyieldable(), "
                "coroutine.wrap(coroutine.isyieldable)()") == "true false false false true");
}

TEST_CASE("a coroutine can be closed", "[lua][coroutine]") {
    Box box;
    CHECK(box.run("local log = '' local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = "
                  "function(_, e) log = log .. 'closed' .. tostring(e) end }) "
                  "coroutine.yield() end) coroutine.resume(c) return coroutine.close(c), log, coroutine.status(c)") ==
          "true closednil dead");
    CHECK(box.run("local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = function() "
                  "error('in close', 0) end }) coroutine.yield() end) "
                  "coroutine.resume(c) return coroutine.close(c)") == "false in close");
    CHECK(
        box.run(
            "local c = coroutine.create(function() error('x', 0) end) coroutine.resume(c) return coroutine.close(c)") ==
        "false x");
    CHECK(box.run("return coroutine.close(coroutine.create(print))") == "true");
    CHECK(box.run("return coroutine.close(coroutine.running())") == "box.lua:1: cannot close a running coroutine");
    CHECK(box.run("local log = '' local c = coroutine.wrap(function() local x <close> = setmetatable({}, { __close = "
                  "function(_, e) log = e end }) error('x', 0) end) "
                  "return pcall(c), log") == "false x");
    CHECK(box.run("local c = coroutine.wrap(function() local x <close> = setmetatable({}, { __close = function() "
                  "error('y', 0) end }) error('x', 0) end) return pcall(c)") == "false y");
}

TEST_CASE("a coroutine lives on from call to call", "[lua][coroutine]") {
    Box box;
    CHECK(box.run("steps = coroutine.wrap(function() local n = 0 while true do n = n + 1 coroutine.yield(n) end end) "
                  "return steps()") == "1");
    for (int i = 2; i < 100; ++i) CHECK(box.run("return steps()") == std::to_string(i));
}

TEST_CASE("an error in a coroutine says its own line", "[lua][coroutine]") {
    Box box;
    CHECK(box.run("local c = coroutine.wrap(function()\n  local x = nil + 1\nend)\n\nc()") ==
          "box.lua:2: attempt to perform arithmetic on a nil value");
    CHECK(box.run("local c = coroutine.create(function()\n  error('stop')\nend)\nassert(coroutine.resume(c))") ==
          "box.lua:4: box.lua:2: stop");
}

}  // namespace
}  // namespace nezumi
