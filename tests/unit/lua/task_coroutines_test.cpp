// Coroutines that wait in tasks, and others that get hold of them.
#include "tests/unit/lua/task_rig.hpp"

using namespace nezumi;

TEST_CASE("a coroutine that waits in a task is resumed and closed by nobody else, and lives on", "[lua][tasks]") {
    const auto [attempt, text] = GENERATE(table<Text, Text>({
        {"coroutine.resume(inner)", "false a coroutine that waits in a task can't be resumed by others"},
        {"coroutine.resume(outer)", "false a coroutine that waits in a task can't be resumed by others"},
        {"coroutine.resume(whole)", "false a coroutine that waits in a task can't be resumed by others"},
        {"pcall(function() wrapped() end)",
         "false robot_controller.lua:20: a coroutine that waits in a task can't be resumed by others"},
        {"pcall(coroutine.close, inner)", "false a coroutine that waits in a task can't be closed by others"},
        {"pcall(coroutine.close, whole)", "false a coroutine that waits in a task can't be closed by others"},
    }));
    CAPTURE(attempt);
    TaskRig rig(R"(
local inner, outer, whole, wrapped
task("t", function()
  whole = coroutine.running()
  inner = coroutine.create(function() wait(0.03) coroutine.yield("a") return "b" end)
  wrapped = coroutine.wrap(function() return coroutine.resume(inner) end)
  outer = coroutine.create(function() return wrapped() end)
  local _, _, text = coroutine.resume(outer)
  local _, other = coroutine.resume(inner)
  note(text .. other)
end)
command("attempt", function()
  local done, text = )" +
                attempt +
                R"(
  note(tostring(done) .. " " .. tostring(text))
end)
)");
    rig.tick(2);
    rig.call("attempt", "");
    rig.tick(3);
    CHECK(rig.noted() == text + "@0.02 ab@0.03 ");
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("a coroutine whose task has ended is free: it can be closed, and goes on no more", "[lua][tasks]") {
    const auto [attempt, text] = GENERATE(table<Text, Text>({
        {"coroutine.close(inner)", "closed@0.02 true nil@0.02 "},
        {"coroutine.resume(inner)",
         "false robot_controller.lua:13: the task in which this coroutine waited has "
         "ended@0.02 "},
    }));
    CAPTURE(attempt);
    TaskRig rig(R"(
local inner
task("t", function()
  inner = coroutine.create(function()
    local guard <close> = setmetatable({}, { __close = function() note("closed") end })
    wait(1)
  end)
  coroutine.wrap(function() coroutine.resume(inner) end)()
end)
command("attempt", function()
  local done, text = )" +
                attempt +
                R"(
  note(tostring(done) .. " " .. tostring(text))
end)
)");
    rig.tick(2);
    CHECK(rig.call("give_up", "t") == "true");
    rig.call("attempt", "");
    rig.tick();
    CHECK(rig.noted() == text);
}
