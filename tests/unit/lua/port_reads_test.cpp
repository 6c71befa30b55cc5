// Arrays that a port gives in the same table each time, because the script can't tell.
#include "bindings/lua/syntax/port_reads.hpp"

#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

using Shorts = std::vector<std::int16_t>;

// Whether `p` is read in place in a callback with this body.
bool is_in_place(const std::string& body, const std::string& declaration = "local p = input('p', 'TimedShortSeq')") {
    const std::string text = declaration + "\nfunction on_execute()\n" + body + "\nend\n";
    const SyntaxTree tree(text);
    REQUIRE(tree.error() == nullptr);
    return ports_read_in_place(tree) == std::vector<std::string>{"p"};
}

}  // namespace

TEST_CASE("a message is used in place if only its elements, fields and length are taken", "[lua][port]") {
    CHECK(is_in_place("if p:read()[1] > 3 and #p:read() > 2 then end"));
    CHECK(is_in_place("for i, x in ipairs(p:read()) do log.info(x) end"));
    CHECK(is_in_place("local a, b = table.unpack(p:read(), 1, 2)"));
    CHECK(is_in_place("local r = p:read() for _, x in ipairs(r) do f(x, r[1], #r, p.is_new) end"));
    CHECK(is_in_place("local r = p:read() f(r.x, r.position.y, p:read().heading)"));
    CHECK(is_in_place("local n, r = 3, (p:read()) return r[n], (r)[1]"));
    CHECK(is_in_place("local r = p:read()"));
    CHECK(is_in_place("f(p:read()[1])", "local a, p <const> = output('o', 'TimedLong'), input('p', 'TimedShortSeq')"));
}

TEST_CASE("a message that may be used later is not in place", "[lua][port]") {
    CHECK_FALSE(is_in_place("f(p:read())"));
    CHECK_FALSE(is_in_place("return p:read()"));
    CHECK_FALSE(is_in_place("state.last = p:read()"));
    CHECK_FALSE(is_in_place("last = { p:read() }"));
    CHECK_FALSE(is_in_place("local iterate, all = ipairs(p:read())"));
    CHECK_FALSE(is_in_place("for i, x in pairs(p:read()) do end"));
    CHECK_FALSE(is_in_place("local ipairs = f for i, x in ipairs(p:read()) do end"));
    CHECK_FALSE(is_in_place("local r = p:read() r[1] = 0"));
    CHECK_FALSE(is_in_place("local r = p:read() r.x = 0"));
    CHECK_FALSE(is_in_place("local r = p:read() function r.f() end"));
    CHECK_FALSE(is_in_place("local r = p:read() r:f()"));
    CHECK_FALSE(is_in_place("local r = p:read() r[1], r = 0, 0"));
    CHECK_FALSE(is_in_place("local r = p:read() local s = r return s"));
    CHECK_FALSE(is_in_place("local r = p:read() return r == last"));
    CHECK_FALSE(is_in_place("local r = p:read() later = function() return r[1] end"));
    CHECK_FALSE(is_in_place("local r r = p:read() return r[1]"));
    // The port itself is used otherwise.
    CHECK_FALSE(is_in_place("f(p)"));
    CHECK_FALSE(is_in_place("local read = p.read return read(p)[1]"));
    CHECK_FALSE(is_in_place("return p['read'](p)[1]"));
    CHECK_FALSE(is_in_place("local q = p return q:read()[1]"));
    CHECK_FALSE(is_in_place("p = nil"));
    // Not known to be this port, or no variable of the file.
    CHECK_FALSE(is_in_place("return p:read()[1]", "local p = input('p' .. '', 'TimedShortSeq')"));
    CHECK_FALSE(is_in_place("return p:read()[1]", "local p if f then p = input('p', 'TimedShortSeq') end"));
    CHECK_FALSE(is_in_place("return p:read()[1]", "do local p = input('p', 'TimedShortSeq') end"));
    CHECK_FALSE(is_in_place("return p:read()[1]", "local input = f local p = input('p', 'TimedShortSeq')"));
}

TEST_CASE("an array that is read in place has the elements of each message, and makes no garbage", "[lua][port]") {
    ScriptRig rig(
        "local p = input('p', 'TimedShortSeq')\n"
        "local out = output('out', 'TimedString')\n"
        "function on_execute()\n"
        "  local text = #p:read() .. ':'\n"
        "  for _, x in ipairs(p:read()) do text = text .. ' ' .. x end\n"
        "  out:write(text .. ' ' .. tostring(p:read()[3]))\n"
        "end");
    rig.activate();
    const auto of = [&](Shorts values) {
        rig.feed<Shorts>("p", std::move(values));
        rig.tick();
        return rig.out<std::string>("out").read();
    };
    CHECK(of({1, 2, 3}) == "3: 1 2 3 3");
    CHECK(of({4}) == "1: 4 nil");
    CHECK(of({}) == "0: nil");
    CHECK(of({5, 6, 7, 8, 9}) == "5: 5 6 7 8 9 7");
    CHECK(of({0, 1}) == "2: 0 1 nil");

    // With garbage, the memory would grow until it is collected.
    ScriptRig sums(
        "local p = input('p', 'TimedShortSeq')\n"
        "local sum = 0\n"
        "function on_execute() for _, x in ipairs(p:read()) do sum = sum + x end end");
    sums.activate();
    sums.feed<Shorts>("p", Shorts(100, 1));
    sums.tick(2);
    const std::size_t before = sums.component->script().memory();
    sums.tick(5);
    CHECK(sums.component->script().memory() == before);
}

TEST_CASE("a structure that is read in place has the fields of each message", "[lua][port]") {
    ScriptRig rig(
        "local p = input('p', 'TimedPose2D')\n"
        "local out = output('out', 'TimedString')\n"
        "local first\n"
        "function on_execute()\n"
        "  local r = p:read()\n"
        "  first = first or r.position\n"
        "  out:write(('%g %g %g'):format(r.position.x, r.heading, first.x))\n"
        "end");
    rig.activate();
    rig.feed<Pose2D>("p", {{1, 2}, 3});
    rig.tick();
    CHECK(rig.out<std::string>("out").read() == "1 3 1");
    rig.feed<Pose2D>("p", {{4, 5}, 6});
    rig.tick();
    CHECK(rig.out<std::string>("out").read() == "4 6 1");
}

TEST_CASE("a coroutine keeps the array that it has read while it waits", "[lua][port]") {
    ScriptRig rig(
        "local p = input('p', 'TimedShortSeq')\n"
        "local out = output('out', 'TimedString')\n"
        "local later = coroutine.wrap(function()\n"
        "  while true do local r = p:read() coroutine.yield() out:write(r[1] .. ' of ' .. #r) end\n"
        "end)\n"
        "task('slow', function() local r = p:read() wait(0.02) log.info('task ' .. r[1]) end)\n"
        "function on_execute() if p:read()[1] then later() end end");
    rig.activate();
    for (std::int16_t first = 1; first <= 4; ++first) {
        rig.feed<Shorts>("p", {first, 0});
        rig.tick();
    }
    CHECK(rig.out<std::string>("out").read() == "3 of 2");
    CHECK(rig.log == std::vector<std::string>{"info: task 1"});
}

TEST_CASE("a message of a queue is not overwritten by the next one", "[lua][port]") {
    ScriptRig rig(
        "local p = input('p', 'TimedShortSeq', '', { queue = 4 })\n"
        "local out = output('out', 'TimedString')\n"
        "function on_execute()\n"
        "  if not p.is_new then return end\n"
        "  local first = p:read()\n"
        "  local second = p:read()\n"
        "  out:write(first[1] .. ' ' .. second[1])\n"
        "end");
    rig.activate();
    rig.feed<Shorts>("p", {1});
    rig.feed<Shorts>("p", {2});
    rig.tick();
    CHECK(rig.out<std::string>("out").read() == "1 2");
}
