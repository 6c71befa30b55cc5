// Tasks: what a script does one after the other, across executions.
#include "tests/unit/lua/task_rig.hpp"

using namespace nezumi;

namespace {

// What an execution whose only task has this body says when it fails.
Text task_failure(const Text& body) {
    TaskRig rig("task('t', function() " + body + " end)");
    rig.component->script().set_budget(headless_budget);
    rig.tick(3);
    return rig.status() == "ERROR" ? rig.error() : "";
}

}  // namespace

TEST_CASE("a task does one thing after the other, and waits in between", "[lua][tasks]") {
    TaskRig rig(R"(
task("steps", function()
  note("a")
  note(("%.2f"):format(wait(0.05)))
  note(("%.2f"):format(wait(0.1 + 0.2)))
end)
)");
    rig.tick(50);
    CHECK(rig.noted() == "a@0.00 0.05@0.05 0.30@0.35 ");
    CHECK(rig.seen("steps", "status") == "finished");
}

TEST_CASE("a wait ends at the first execution at its time or after it", "[lua][tasks]") {
    const auto [seconds, expected] = GENERATE(table<Text, Text>(
        {{"0", "b@0.01 "}, {"0.001", "b@0.01 "}, {"0.01", "b@0.01 "}, {"0.011", "b@0.02 "}, {"0.03", "b@0.03 "}}));
    TaskRig rig("task('t', function() wait(" + seconds + ") note('b') end)");
    rig.tick(10);
    CHECK(rig.noted() == expected);
}

TEST_CASE("a wait for a condition looks at once, then once an execution, and gives up in time", "[lua][tasks]") {
    TaskRig rig(R"(
local looks = 0
task("t", function()
  note(tostring(wait_until(function() return true end)))
  note(tostring(wait_until(function() looks = looks + 1 return near:read() > 3 end)) .. looks)
  note(tostring(wait_until(function() return false end, { within = 0.03 })))
  note(tostring(wait_until(function() return false end, { within = 0 })))
end)
)");
    rig.tick(2);
    rig.feed("near", 7);
    rig.tick(10);
    CHECK(rig.noted() == "true@0.00 true3@0.02 false@0.05 false@0.05 ");
}

TEST_CASE("slices run in the order of the declarations, before on_execute, whose write is the later one",
          "[lua][tasks]") {
    TaskRig rig(R"(
task("first", function() note("1") end, { repeating = true })
task("second", function() note("2") end, { repeating = true })
function on_execute() note("x") end
)");
    rig.tick(2);
    CHECK(rig.noted() == "1@0.00 2@0.00 x@0.00 1@0.01 2@0.01 x@0.01 ");
}

TEST_CASE("a task that repeats begins again at the execution after its end", "[lua][tasks]") {
    TaskRig rig("task('t', function() note('a') wait(0.02) note('b') end, { repeating = true })");
    rig.tick(6);
    CHECK(rig.noted() == "a@0.00 b@0.02 a@0.03 b@0.05 ");
}

TEST_CASE("the whole task waits, in coroutines of its own and under pcall as well", "[lua][tasks]") {
    TaskRig rig(R"(
local function generate() for i = 1, 3 do wait(0.01) coroutine.yield(i) end end
task("t", function()
  for i in coroutine.wrap(generate) do note(tostring(i)) end
  note(tostring(pcall(function() wait(0.02) error("x") end)))
  local co = coroutine.create(function(...) return wait_until(function() return near:read() == 1 end), ... end)
  note(table.concat({ tostring(coroutine.resume(co, "more")), coroutine.status(co) }))
  local nested = coroutine.wrap(function() return coroutine.wrap(function() return wait(0.01) end)() end)
  note(("%.2f"):format(nested()))
  note(tostring(select(2, xpcall(function() wait(0.01) error("y", 0) end, function(text) return text .. "!" end))))
end)
)");
    rig.tick(6);
    rig.feed("near", 1);
    rig.tick(20);
    CHECK(rig.noted() == "1@0.01 2@0.02 3@0.03 false@0.05 truedead@0.06 0.01@0.07 y!@0.08 ");
}

TEST_CASE("a task is started and cancelled by hand", "[lua][tasks]") {
    TaskRig rig(R"(
task("t", function()
  local closed <close> = setmetatable({}, { __close = function() note("closed") end })
  note("a") wait(0.05) note("b")
end)
)");
    rig.tick();
    CHECK(rig.call("begin", "t") == "robot_controller.lua:6: task 't' is under way already");
    CHECK(rig.call("begin", "tt") == "robot_controller.lua:6: unknown task 'tt' (did you mean 't'?)");
    CHECK(rig.call("give_up", "t") == "true");
    CHECK(rig.seen("t", "status") == "cancelled");
    CHECK(rig.call("give_up", "t") == "false");
    rig.tick(8);
    CHECK(rig.noted() == "a@0.00 closed@0.01 ");
    CHECK(rig.call("begin", "t").empty());
    CHECK(rig.seen("t", "status") == "ready");
    rig.tick(8);
    CHECK(rig.noted() == "a@0.00 closed@0.01 a@0.09 b@0.14 closed@0.14 ");
}

TEST_CASE("a task may cancel others and itself, from within its coroutines", "[lua][tasks]") {
    TaskRig rig(R"(
task("other", function() note("o") wait(1) note("never") end)
task("t", function()
  local closed <close> = setmetatable({}, { __close = function() note("closed") end })
  note(tostring(cancel("other")))
  wait(0.01)
  coroutine.wrap(function() cancel("t") note("never") end)()
  note("never")
end)
)");
    rig.tick(8);
    CHECK(rig.noted() == "o@0.00 true@0.00 closed@0.01 ");
    CHECK(rig.seen("t", "status") == "cancelled");
    CHECK(rig.seen("other", "status") == "cancelled");
    CHECK(rig.call("begin", "t").empty());
    rig.tick();
    CHECK(rig.noted() == "o@0.00 true@0.00 closed@0.01 false@0.08 ");
}

TEST_CASE("what can't wait says so", "[lua][tasks]") {
    const Text place = "robot_controller.lua:9: ";
    const auto [body, expected] = GENERATE(table<Text, Text>({
        {"table.sort({ 2, 1 }, function() wait(1) end)",
         "wait can't be called here: a function that Lua's library calls (as table.sort does) can't wait"},
        {"coroutine.wrap(function() table.sort({ 2, 1 }, function() coroutine.wrap(function() wait(1) end)() end) "
         "end)()",
         "wait can't be called here: a function that Lua's library calls (as table.sort does) can't wait"},
        {"('x'):gsub('x', function() wait_until(function() end) end)",
         "wait_until can't be called here: a function that Lua's library calls (as table.sort does) can't wait"},
        {"wait_until(function() wait(1) end)",
         "wait can't be called here: a function that Lua's library calls (as table.sort does) can't wait"},
        {"table.sort({ 2, 1 }, function() cancel('t') end)",
         "cancel can't be called here: a function that Lua's library calls (as table.sort does) can't wait"},
        {"wait(-1)", "wait expected finite seconds of at least 0, got -1"},
        {"wait(1/0)", "wait expected finite seconds of at least 0, got inf"},
        {"wait()", "wait expected seconds, got nothing"},
        {"wait('1')", "wait expected seconds, got string"},
        {"wait(1, 2)", "wait: expected at most 1 argument, got 2: wait(seconds)"},
        {"wait_until(3)", "wait_until expected a function, got number"},
        {"wait_until(function(x) end)", "wait_until: its parameter 'x' is never given: leave it out"},
        {"wait_until(function() end, { within = -1 })",
         "wait_until: option 'within' expected a number from 0 on, got -1"},
        {"wait_until(function() end, { withn = 1 })", "wait_until: unknown option 'withn' (did you mean 'within'?)"},
        {"coroutine.yield(1)", "attempt to yield from outside a coroutine"},
    }));
    CAPTURE(body);
    CHECK(task_failure("\n" + body) == place + expected);
}

TEST_CASE("what is wrong with a task is told where it is declared", "[lua][tasks]") {
    const auto [text, expected] = GENERATE(table<Text, Text>({
        {"task('t')", "task 't': expected a function, got nothing"},
        {"task(1, function() end)", "task expected a task's name, got number"},
        {"task('2t', function() end)",
         "task '2t': the name is no identifier: use letters, digits and _, no digit first"},
        {"task('wait', function() end)",
         "task 'wait': the name is one of a component's own words: choose another, as 'my_wait'"},
        {"task('t', function() end) task('t', function() end)", "task 't' is declared twice (first in line 1)"},
        {"task('t', function(x) end)", "task 't': its parameter 'x' is never given: leave it out"},
        {"task('t', function() end, { repeat_it = true })",
         "task 't': unknown option 'repeat_it' (did you mean 'repeating'?)"},
        {"task('t', function() end, { repeating = 1 })",
         "task 't': option 'repeating' expected true or false, got number"},
        {"start('t')", "start can't be called while the file loads"},
        {"wait(1)", "wait can only be called in a task: task(\"name\", function() ... end)"},
    }));
    CAPTURE(text);
    CHECK(refusal(text) == "robot_controller.lua:1: " + expected);
    CHECK(failure_of("", "task('t', function() end)") ==
          "robot_controller.lua:3: task can only be called while the file loads");
    CHECK(failure_of("", "wait(1)") ==
          "robot_controller.lua:3: wait can only be called in a task: task(\"name\", function() ... end)");
}

TEST_CASE("an error in a task is the component's, with its line, and takes the execution's writes along",
          "[lua][tasks]") {
    TaskRig rig(R"(
function on_execute() note("x") end
task("good", function() wait(0.02) note("discarded") end)
task("bad", function()
  wait(0.02)
  local missing
  coroutine.wrap(function() return missing.field end)()
end)
)");
    rig.tick(3);
    CHECK(rig.noted() == "x@0.00 x@0.01 ");
    CHECK(rig.error() == "robot_controller.lua:14: attempt to index a nil value (upvalue 'missing')");
    CHECK(rig.seen("bad", "status") == "failed");
    REQUIRE(rig.component->reset(rig.now));
    rig.activate().tick();
    CHECK(rig.status() == "ACTIVE");
    CHECK(rig.seen("bad", "status") == "waiting");
}

TEST_CASE("an error in a module that a task calls names the task's line as well", "[lua][tasks]") {
    ScriptContext context;
    context.find_module = [](std::string_view, std::string_view) {
        return source("return { fail = function() error('no luck') end }", "helper.lua");
    };
    ScriptRig rig("local helper = require 'helper'\ntask('t', function()\n  wait(0)\n  helper.fail()\nend)", context);
    rig.activate().tick(2);
    CHECK(rig.error() == "helper.lua:1: no luck (called from robot_controller.lua:4)");
}

TEST_CASE("an error of a task may be any value", "[lua][tasks]") {
    CHECK(task_failure("error('plain', 0)") == "robot_controller.lua:8: plain");
    CHECK(task_failure("error({})") == "robot_controller.lua:8: an error of type table");
    CHECK(task_failure("error(setmetatable({}, { __tostring = function() return 'mine' end }))") ==
          "robot_controller.lua:8: mine");
    CHECK(task_failure("error()") == "robot_controller.lua:8: an error of value nil");
    CHECK(task_failure("local t = {} while true do t[#t + 1] = ('x'):rep(100000) .. #t end") ==
          "robot_controller.lua:8: not enough memory: the script reached its limit of 64 MB");
    CHECK(task_failure("local function f() return f() + 1 end f()").find("stack overflow") != Text::npos);
}

TEST_CASE("deactivation ends tasks, what they have open before on_deactivated", "[lua][tasks]") {
    TaskRig rig(R"(
task("t", function()
  local closed <close> = setmetatable({}, { __close = function() note("closed") end })
  wait(1)
end)
task("unborn", function() end)
function on_deactivated() note("deactivated") end
)");
    rig.tick(2);
    REQUIRE(rig.component->deactivate(rig.now));
    rig.tick(3);
    CHECK(rig.noted() == "closed@0.02 deactivated@0.02 ");
    CHECK(rig.seen("t", "status") == "inactive");
    CHECK(rig.call("begin", "t") ==
          "robot_controller.lua:6: start: tasks run while the component is ACTIVE, it is INACTIVE");
    rig.activate().tick();
    CHECK(rig.seen("t", "status") == "waiting");
}

TEST_CASE("what tasks write while a deactivation closes them stands in for no safe value", "[lua][tasks]") {
    const auto [hook, velocity, number] = GENERATE(table<Text, double, std::int32_t>(
        {{"", 0.0, -1}, {"function on_deactivated() vel:write { vx = 0.2 } count:write(5) end", 0.2, 5}}));
    TaskRig rig(R"(
local vel = output("vel", "TimedVelocity2D")
local count = output("count", "TimedLong", { safe = -1 })
local plain = output("plain", "TimedLong")
task("t", function()
  local closed <close> = setmetatable({}, { __close = function() vel:write { vx = 0.3 } count:write(77) plain:write(8) end })
  wait(1)
end)
)" + hook);
    rig.tick(2);
    REQUIRE(rig.component->deactivate(rig.now));
    rig.tick();
    CHECK(rig.out<Velocity2D>("vel").read().vx == velocity);
    CHECK(rig.out<std::int32_t>("count").read() == number);
    CHECK(rig.out<std::int32_t>("plain").read() == 8);
}

TEST_CASE("an error ends tasks before on_aborting, and a closer that fails is an error", "[lua][tasks]") {
    TaskRig rig(R"(
task("t", function()
  local closed <close> = setmetatable({}, { __close = function() note("closed") error("stuck", 0) end })
  wait(1)
end)
function on_aborting() note("aborting") end
command("fail", function() error("failed") end)
)");
    rig.tick(2);
    const auto done = rig.component->deactivate(rig.now);
    REQUIRE_FALSE(done);
    CHECK(describe(done.error()).find("stuck") != Text::npos);
    CHECK(rig.status() == "ERROR");
    rig.tick();
    CHECK(rig.noted() == "closed@0.02 aborting@0.02 ");
    REQUIRE(rig.component->reset(rig.now));
    rig.activate().tick();
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("a task that never waits uses up the execution's budget", "[lua][tasks][watchdog]") {
    const Text body =
        GENERATE(as<Text>{}, "while true do end", "coroutine.wrap(function() while true do end end)()",
                 "while true do pcall(function() while true do end end) end", "wait(0.01) while true do end");
    TaskRig rig("task('t', function() " + body + " end) function on_execute() note('x') end");
    rig.component->script().set_budget({0.05});
    rig.tick(3);
    CHECK(rig.error() == "robot_controller.lua:8: ran for more than 0.05 s: is there an endless loop?");
    CHECK(rig.seen("t", "status") == "failed");
    REQUIRE(rig.component->reset(rig.now));
    CHECK(rig.status() == "INACTIVE");
}

TEST_CASE("a task is seen from outside", "[lua][tasks]") {
    TaskRig rig(R"(
task("b", function() wait(0.5) end)
task("a", function()
  wait_until(function() return false end, { within = 2 })
  wait_until(function() return false end)
end)
)");
    CHECK(rig.seen("b", "status") == "ready");
    rig.tick(11);
    CHECK(rig.seen("b", "status") == "waiting");
    CHECK(rig.seen("b", "waiting") == "0.5 s, 0.4 s are left");
    CHECK(rig.seen("b", "line") == "9");
    CHECK(rig.seen("b", "since") == "0");
    CHECK(rig.seen("a", "waiting") == "a condition, 1.9 s are left");
    CHECK(rig.seen("a", "line") == "11");
    rig.tick(250);
    CHECK(rig.seen("b", "status") == "finished");
    CHECK(rig.seen("b", "waiting") == "nil");
    CHECK(rig.seen("b", "line") == "nil");
    CHECK(rig.seen("b", "since") == "0.5");
    CHECK(rig.seen("a", "waiting") == "a condition");
    CHECK(rig.seen("a", "line") == "12");
}

TEST_CASE("a reload begins tasks anew, with the state kept, and says so", "[lua][tasks][reload]") {
    const Text wait = GENERATE(as<Text>{}, "wait(1)", "wait_until(function() return false end)",
                               "coroutine.wrap(function() wait(1) end)()", "pcall(wait, 1)");
    const auto text = [&](const Text& step) {
        return "local out = output('out', 'TimedLong') state.n = state.n or 0\ntask('count', function() while true do "
               "state.n = state.n + " +
               step + " out:write(state.n) " + wait + " end end)\n";
    };
    ReloadRig world;
    world.add_text("it", text("1"));
    world.tick(3);
    CHECK(world.out<std::int32_t>("it.out") == 1);
    CHECK(world.change("it.lua", text("10")) == "");
    CHECK(world.said("it: tasks begin anew: count"));
    world.tick(3);
    CHECK(world.out<std::int32_t>("it.out") == 11);
    CHECK(world.change("it.lua", text("10") + "function on_reload() cancel('count') end") == "");
    world.tick(3);
    CHECK(world.out<std::int32_t>("it.out") == 11);
}

TEST_CASE("a roll-back in probation goes on where the old version's tasks stood", "[lua][tasks][reload]") {
    ReloadRig world;
    const Text good =
        "local out = output('out', 'TimedLong')\ntask('t', function() out:write(1) wait(0.05) out:write(2) end)\n";
    ScriptComponent& it = world.add_text("it", good);
    world.tick(2);
    CHECK(world.change("it.lua",
                       "local out = output('out', 'TimedLong')\ntask('t', function() out:write(7) wait(0.01) "
                       "error('late') end)\n") == "");
    world.tick();
    CHECK(world.out<std::int32_t>("it.out") == 7);
    world.tick();
    CHECK(it.version() == 1);
    CHECK(world.said("version 2 failed in execution 2 of its first 10: it.lua:2: late; back to version 1"));
    CHECK(world.out<std::int32_t>("it.out") == 7);
    world.tick(2);
    CHECK(world.out<std::int32_t>("it.out") == 2);
    CHECK(world.system.now().tick == 6);
}
