// What tasks have open is closed when they are ended, and what may go wrong then.
#include "tests/unit/lua/task_rig.hpp"

using namespace nezumi;

namespace {

// A task in line 8 whose closer does this, and other parts.
Text task_with(const Text& closer, const Text& more = "") {
    return "task('t', function()\n  local x <close> = setmetatable({}, { __close = function() " + closer +
           " end })\n  wait(10)\nend)\n" + more;
}

}  // namespace

TEST_CASE("an error of a closer has its own place, however its task is ended", "[lua][tasks]") {
    const Text wanted = "robot_controller.lua:9: closer";
    TaskRig deactivated(task_with("error('closer')"));
    deactivated.tick();
    const auto done = deactivated.component->deactivate(deactivated.now);
    REQUIRE_FALSE(done);
    CHECK_THAT(done.error().message, Catch::EndsWith(" went to ERROR: " + wanted));
    CHECK(deactivated.error() == wanted);

    TaskRig by_command(task_with("error('closer')"));
    by_command.tick();
    CHECK(by_command.call("give_up", "t") == wanted);

    TaskRig by_itself(
        "task('t', function()\n  local x <close> = setmetatable({}, { __close = function() error('closer') "
        "end })\n  cancel('t')\nend)\n");
    by_itself.tick();
    CHECK(by_itself.error() == wanted);
}

TEST_CASE("a later error has its own place although a closer failed and was caught", "[lua][tasks]") {
    TaskRig rig(task_with("error('closer')",
                          "local function fail()\n  error('later', 0)\nend\nfunction on_execute()\n"
                          "  if now() > 0.015 then pcall(cancel, 't') fail() end\nend\n"));
    rig.tick(3);
    CHECK(rig.error() == "robot_controller.lua:13: later");
}

TEST_CASE("an error whose __tostring fails in a task is told once", "[lua][tasks]") {
    TaskRig rig(
        "task('t', function()\n  error(setmetatable({}, { __tostring = function()\n    error('no text')\n  end "
        "}))\nend)\n");
    rig.tick();
    CHECK(rig.error() == "robot_controller.lua:10: no text");
}

TEST_CASE("a closer that waits is told that it can't, as its task is being ended", "[lua][tasks]") {
    const Text wait = GENERATE(as<Text>(), "wait(0.1)", "wait_until(function() return true end)");
    TaskRig rig(task_with(wait, "function on_execute() if now() > 0.005 then error('failed') end end"));
    rig.tick(2);
    CHECK(rig.error() == "robot_controller.lua:12: failed");
    const Text word = wait.substr(0, wait.find('('));
    CHECK(rig.log.back() == "error: the end of its tasks failed: robot_controller.lua:9: " + word +
                                " can't be called here: the task is being ended, and what it closes can't wait");
    REQUIRE(rig.component->reset(rig.now));
}

TEST_CASE("a task waits as ever after another was ended beside it", "[lua][tasks]") {
    TaskRig rig(task_with("note('closed')",
                          "task('other', function()\n  wait(0.005)\n  cancel('t')\n  wait(0.01)\n"
                          "  note('went on')\nend)\n"));
    rig.tick(4);
    CHECK_THAT(rig.noted(), Catch::Contains("closed@") && Catch::Contains("went on@"));
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("a task waits as ever after it failed to end another, where the C stack was used up", "[lua][tasks]") {
    // Each closes the next one: Lua does not count these calls.
    TaskRig rig(R"(task('other', function() wait(10) end)
local all, why, _ = {}
local function close(i)
  if not pcall(coroutine.close, all[i]) and not why then _, why = pcall(cancel, 'other') end
end
task('t', function()
  for i = 1, 5000 do
    all[i] = coroutine.create(function()
      local x <close> = setmetatable({}, { __close = function() close(i + 1) end })
      coroutine.yield()
    end)
    coroutine.resume(all[i])
  end
  close(1)
  wait(0.01)
  note(why)
end)
)");
    rig.tick(3);
    CHECK(rig.error() == "");
    CHECK_THAT(rig.noted(), Catch::StartsWith("C stack overflow@"));
}
