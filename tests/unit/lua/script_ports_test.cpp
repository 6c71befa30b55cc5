// Port objects in Lua: values in, values out, their properties, and the messages about wrong use.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

TEST_CASE("an execution that writes endlessly is an error before the memory is full", "[lua][ports]") {
    const auto error_of = [](const std::string& body) {
        ScriptRig rig(
            "local a = output('a', 'TimedString') local b = output('b', 'TimedVelocity2D')\nfunction on_execute()\n" +
                body + "\nend",
            {.budget = Budget{20}});
        rig.activate().tick();
        return rig.error();
    };
    CHECK(error_of("local text = ('x'):rep(1e7)\nfor i = 1, 1e4 do a:write(text) end") ==
          "robot_controller.lua:4: output 'a' (TimedString): is there an endless loop? It has written more than 64 MB "
          "in one execution");
    CHECK(error_of("while true do b:write {} end") ==
          "robot_controller.lua:3: output 'b' (TimedVelocity2D): is there an endless loop? It has written more than 64 "
          "MB in one execution");
    ScriptRig rig("local a = output('a', 'TimedString') function on_execute() a:write(('x'):rep(1e7)) end",
                  {.budget = Budget{20}});
    rig.activate().tick(10);  // each execution counts again
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("the log of a second is limited, and the next second can log again", "[lua][ports]") {
    ScriptRig rig("local text = ('x'):rep(100000) function on_execute() for i = 1, 8 do log.info(text) end end");
    rig.activate().tick();
    CHECK(rig.log.size() == 8);
    rig.tick(99);
    REQUIRE(rig.log.size() == 11);
    CHECK(rig.log.back() == "warn: more than 1 MB of log in one second: the rest of that second is dropped");
    rig.tick(2);
    CHECK(rig.log.size() == 22);
    CHECK(rig.log.back() == "warn: more than 1 MB of log in one second: the rest of that second is dropped");
}
