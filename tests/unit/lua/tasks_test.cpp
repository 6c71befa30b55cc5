// Tasks: what a script does one after the other, across executions.
#include "tests/unit/lua/task_rig.hpp"

using namespace nezumi;

TEST_CASE("a task that never waits ends with the execution's time", "[lua][tasks][watchdog]") {
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

TEST_CASE("a reload starts tasks again, keeps the state, and reports it", "[lua][tasks][reload]") {
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
    CHECK(world.said("it: tasks start again: count"));
    world.tick(3);
    CHECK(world.out<std::int32_t>("it.out") == 11);
    CHECK(world.change("it.lua", text("10") + "function on_reload() cancel('count') end") == "");
    world.tick(3);
    CHECK(world.out<std::int32_t>("it.out") == 11);
}

TEST_CASE("a version that goes back in its first executions continues its tasks", "[lua][tasks][reload]") {
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
    CHECK(world.said("version 2 failed in its execution 2 (of the first 10): it.lua:2: late; back to version 1"));
    CHECK(world.out<std::int32_t>("it.out") == 7);
    world.tick(2);
    CHECK(world.out<std::int32_t>("it.out") == 2);
    CHECK(world.system.now().tick == 6);
}
