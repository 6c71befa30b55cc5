// What is refused when a file loads, with its line and the nearest known name.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

TEST_CASE("a file that takes too much time or memory to load is refused with its line", "[lua][refusals][watchdog]") {
    CHECK(refusal("param('x', 1)\nwhile true do end", {.budget = {0.02}}) ==
          "robot_controller.lua:2: ran for more than 0.02 s: is there an endless loop?");
    CHECK(refusal("local t = {}\nfor i = 1, 1e9 do t[i] = {} end", {.budget = {5}, .memory_limit = 1 << 20}) ==
          "robot_controller.lua:2: not enough memory: the script reached its limit of 1 MB");
}

TEST_CASE("a script that fails in any way only sends its component to ERROR", "[lua][refusals][watchdog]") {
    for (const std::string body :
         {"error(nil)", "error({})", "assert(false)", "local t t.x = 1",
          "coroutine.wrap(function() error('inside') end)()", "while true do end",
          "pcall(function() while true do end end)", "coroutine.wrap(function() while true do end end)()",
          "local function f() return 1 + f() end f()", "local t = {} while true do t[#t + 1] = ('x'):rep(1e6) end",
          "local s = 'x' while true do s = s .. s end", "setmetatable({}, { __gc = function() while true do end end })",
          ";('a'):rep(32):find(('a?'):rep(32) .. ('a'):rep(32))", "string.rep('', 1 << 60)",
          "table.move({}, 1, 1 << 60, 2)", "table.unpack(setmetatable({}, { __len = function() return 1 << 60 end }))",
          "state.f.g = 1", "coroutine.yield()"}) {
        INFO(body);
        ScriptRig rig("local vel = output('vel', 'TimedVelocity2D')\nfunction on_execute() vel:write { vx = 1 }\n" +
                          body + "\nend",
                      {.budget = {0.05}, .memory_limit = 8 << 20});
        rig.activate().tick();
        CHECK(rig.status() == "ERROR");
        CAPTURE(rig.error());
        CHECK(rig.error().starts_with("robot_controller.lua:3:"));
        CHECK(rig.out<Velocity2D>("vel").read() == Velocity2D{});
        rig.tick(3);
    }
}

TEST_CASE("an endless loop in any callback ends with its time", "[lua][refusals][watchdog]") {
    for (const std::string hook :
         {"on_activated", "on_execute", "on_deactivated", "on_aborting", "on_error", "on_reset"}) {
        INFO(hook);
        ScriptRig rig("function " + hook + "() while true do end end\n" +
                          (hook == "on_execute" || hook == "on_activated" ? "" : "command('fail', print)\n") +
                          (hook == "on_execute"
                               ? ""
                               : "function on_execute() if config.fail then error('x') end end\nparam('fail', false)"),
                      {.budget = {0.02}});
        static_cast<void>(rig.component->activate(rig.now));
        static_cast<void>(rig.component->deactivate(rig.now));
        if (rig.status() == "INACTIVE") static_cast<void>(rig.component->activate(rig.now));
        if (rig.component->parameters().find("fail") != nullptr) REQUIRE(rig.component->parameters().set("fail", true));
        rig.tick(2);
        static_cast<void>(rig.component->reset(rig.now));
        bool said = false;
        for (const std::string& line : rig.log)
            said = said || line.find("ran for more than 0.02 s") != std::string::npos;
        CHECK((said || rig.error().find("ran for more than 0.02 s") != std::string::npos));
    }
}

TEST_CASE("a zero byte does not end a name", "[lua][component]") {
    const ScriptContext context{.find_module = [](std::string_view name, std::string_view) -> Expected<SourceText> {
        return failure("there is no module '" + shown(name) + "'");
    }};
    CHECK(refusal("require 'a\\0b'", context) ==
          "robot_controller.lua:1: require 'a\\x00b': there is no module 'a\\x00b'");
    CHECK(failure_of("param('x', 1)", "config['x\\0y'] = 2").find("unknown parameter 'x\\x00y'") != std::string::npos);
    CHECK(failure_of("local a = input('a', 'TimedLong')", "local _ = a['tm\\0']").find("has no 'tm\\x00'") !=
          std::string::npos);
}
