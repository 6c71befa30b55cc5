// What a port gives in Lua: elements that are not there, and a table that is the script's own.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

using Shorts = std::vector<std::int16_t>;

}  // namespace

TEST_CASE("the error about a missing element has its index and the number of elements", "[lua][port]") {
    const auto fails = [](const std::string& body) {
        ScriptRig rig("local d = input('d', 'TimedShortSeq')\nfunction on_execute()\n  " + body + "\nend");
        rig.activate().feed<Shorts>("d", {1, 2, 3, 4});
        rig.tick();
        return rig.status() == "ERROR" ? rig.error() : std::string();
    };
    CHECK(fails("return d:read()[9] * 2") ==
          "robot_controller.lua:3: attempt to perform arithmetic on a nil value (field 'integer index'): there is no "
          "element 9 among the 4 of input 'd'");
    CHECK_THAT(fails("local i = 0 return d:read()[i] * 2"),
               Catch::EndsWith("nil value (field '?'): there is no element 0 among the 4 of input 'd'"));
    CHECK_THAT(fails("if d:read()[9] > 3 then end"),
               Catch::EndsWith("attempt to compare number with nil: there is no element 9 among the 4 of input 'd'"));
    CHECK_THAT(
        fails("for i = 1, d:read()[9] do end"),
        Catch::EndsWith("bad 'for' limit (number expected, got nil): there is no element 9 among the 4 of input 'd'"));
    CHECK_THAT(fails("for i = d:read()[9], 1 do end"),
               Catch::EndsWith(": there is no element 9 among the 4 of input 'd'"));
    CHECK_THAT(fails("return d:read()[5].x"), Catch::EndsWith(": there is no element 5 among the 4 of input 'd'"));
    // What has nothing to do with it says nothing of it.
    CHECK_THAT(fails("local seen = d:read()[9]\n  return ({})[1] * 2"), Catch::EndsWith("(field 'integer index')"));
    CHECK_THAT(fails("local seen, t = d:read()[9] or 0, {} return t.x * 2"), Catch::EndsWith("(field 'x')"));
    CHECK_THAT(fails("for _ in ipairs(d:read()) do end return ({})[1] * 2"),
               Catch::EndsWith("(field 'integer index')"));
    CHECK(fails("assert(d:read()[9] == nil and #d:read() == 4 and not d:read().x and rawget(d:read(), 9) == nil)")
              .empty());
    CHECK(fails("assert(setmetatable(d:read(), { __index = function() return 7 end })[9] == 7)").empty());
    CHECK(fails("assert(select('#', table.unpack(d:read(), 1, 9)) == 9)").empty());
}

TEST_CASE("a received message is plain data", "[lua][port]") {
    ScriptRig rig(
        "local d = input('d', 'TimedShortSeq') command('c', function() return d:read() end)\n"
        "function on_execute() state.last = d:read() end");
    rig.activate().feed<Shorts>("d", {1, 2});
    rig.tick();
    const auto given = rig.component->call_command("c", {}, rig.now);
    REQUIRE(given);
    REQUIRE(given->tables.size() == 1);
    CHECK(given->tables[0].size() == 2);
    std::vector<Dropped> dropped;
    const auto state = rig.component->script().take_state(dropped);
    REQUIRE(state);
    CHECK(dropped.empty());
    CHECK(state->tables.size() == 2);
}
