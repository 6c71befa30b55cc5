// A file as a component: its life, its words, its commands and modules.
#include <filesystem>

#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

using Text = std::string;

}  // namespace

TEST_CASE("a file is a component type that is named after it", "[lua][component]") {
    CHECK(ScriptRig("param('x', 1)").component->type() == "RobotController");
    CHECK(ScriptRig("param('x', 1)", {}, "marker_follower2.lua").component->type() == "MarkerFollower2");
    CHECK(ScriptRig("param('x', 1)", {}, "my-own behavior.lua").component->type() == "MyOwnBehavior");
    CHECK(ScriptRig("param('x', 1)").component->name() == "controller");
    CHECK(ScriptRig("param('x', 1)").component->version() == 1);
}

TEST_CASE("about describes the file", "[lua][component]") {
    ScriptRig rig("about { version = '1.2', vendor = 'me', category = 'test' } param('x', 1)");
    CHECK(rig.component->script().about().version == "1.2");
    CHECK(rig.component->script().about().vendor == "me");
    CHECK(rig.component->script().about().category == "test");
}

TEST_CASE("an endless command ends with its time, and the component continues", "[lua][component][command][watchdog]") {
    ScriptRig rig("command('loop', function() while true do end end) function on_execute() end");
    rig.activate();
    auto result = rig.component->call_command("loop", {}, rig.now);
    REQUIRE_FALSE(result);
    CHECK(result.error().kind == Error::Kind::out_of_time);
    CHECK(result.error().message == "ran for more than 0.1 s: is there an endless loop?");
    rig.tick();
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("the end of the time limit is distinguished from other errors", "[lua][component][watchdog]") {
    ScriptRig rig("function on_execute() while true do end end", {.budget = {0.02}});
    rig.activate().tick();
    CHECK(rig.status() == "ERROR");
    CHECK(rig.component->last_error().kind == Error::Kind::out_of_time);
    CHECK(rig.error() == "robot_controller.lua:1: ran for more than 0.02 s: is there an endless loop?");
}

TEST_CASE("a failed execution and its on_aborting share one time limit", "[lua][component][watchdog]") {
    ScriptRig rig("function on_execute() while true do end end function on_aborting() while true do end end",
                  {.budget = {0.3}});
    rig.activate();
    const std::int64_t began = thread_time();
    rig.tick();
    const double used = static_cast<double>(thread_time() - began) * 1e-9;
    CHECK(rig.error() == "robot_controller.lua:1: ran for more than 0.3 s: is there an endless loop?");
    CHECK(rig.log.back() ==
          "error: on_aborting failed: robot_controller.lua:1: ran for more than 0.03 s: is there an endless loop?");
    CHECK(used > 0.32);
    CHECK(used < 0.45);

    ScriptRig quick(
        "local led = output('led', 'TimedBoolean') function on_execute() while true do end end "
        "function on_aborting() led:write(true) end",
        {.budget = {0.1}});
    quick.activate().tick();
    CHECK(quick.out<bool>("led").read());
}

TEST_CASE("each required module runs once", "[lua][component][modules]") {
    std::vector<std::string> asked;
    const ModuleFinder find = [&](std::string_view name, std::string_view from) -> Expected<SourceText> {
        asked.push_back(std::string(name) + " for " + std::string(from));
        if (name == "a")
            return source("local b = require 'b' log.info('a') return { double = function(x) return b.twice(x) end }",
                          "a.lua");
        if (name == "b") return source("return { twice = function(x)\n return 2 * x end }", "b.lua");
        if (name == "nothing") return source("local x = 1", "nothing.lua");
        if (name == "bad") return source("local x = 1\nlocal y = = 2", "bad.lua");
        if (name == "slip") return source("local x = 1\nreturn { f = function() xx = 2 end }", "slip.lua");
        if (name == "hook") return source("function on_execute() end", "hook.lua");
        if (name == "cycle1") return source("require 'cycle2'", "cycle1.lua");
        if (name == "cycle2") return source("require 'cycle1'", "cycle2.lua");
        if (name == "fails") return source("local t = nil\nt.x = 1", "fails.lua");
        return failure("there is no module '" + std::string(name) + "'");
    };
    const ScriptContext context{.find_module = find};
    ScriptRig rig(R"(
local a, again = require "a", require "a"
local out = output("out", "TimedLong")
assert(a == again and require "nothing" == true)
function on_execute() out:write(a.double(21)) assert(require "b".twice(2) == 4) end)",
                  context);
    rig.activate().tick();
    CHECK(rig.out<std::int32_t>("out").read() == 42);
    CHECK(asked == std::vector<Text>{"a for behaviors/robot_controller.lua", "b for behaviors/a.lua",
                                     "nothing for behaviors/robot_controller.lua"});
    REQUIRE(rig.component->script().modules().size() == 3);
    CHECK(rig.component->script().modules()[1].path == "behaviors/b.lua");

    CHECK(refusal("require 'a'") == "robot_controller.lua:1: require 'a': this script can't load modules");
}

TEST_CASE("math.random follows the run's seed, the component's name and the version", "[lua][component]") {
    const Text text = "local out = output('out', 'TimedDouble') function on_execute() out:write(math.random()) end";
    const auto first = [&](const std::string& name, std::uint64_t seed) {
        auto component = ScriptComponent::load(name, source(text), {.seed = seed}).value();
        REQUIRE(component->activate({}));
        component->execute({});
        component->latch_outputs({});
        return component->find_out_port("out")->value().get<double>();
    };
    CHECK(first("a", 1) == first("a", 1));
    CHECK(first("a", 1) != first("b", 1));
    CHECK(first("a", 1) != first("a", 2));
}

TEST_CASE("compiled code is shared by all components of a file", "[lua][component]") {
    ChunkCache chunks;
    const ScriptContext context{.chunks = &chunks};
    CHECK(refusal("param('x', 1)", context) == "");
    CHECK(refusal("param('x', 1)", context) == "");
    CHECK(refusal("param('x', 1) param('x', 1)", context) ==
          "robot_controller.lua:1: parameter 'x' is declared twice (first in line 1)");
    CHECK(refusal("param('x', = 1)", context).substr(0, 24) == "robot_controller.lua:1: ");
}

TEST_CASE("a scripted component needs little memory", "[lua][component]") {
    ScriptRig rig(R"(
local range  = input("in", "TimedShortSeq", "distance sensors; a larger value is nearer")
local target = output("out", "TimedVelocity2D", "target velocity")
param("speed_x", 0.0, { min = -1.5, max = 1.5, step = 0.01, widget = "slider", unit = "m/s", doc = "straight-ahead speed" })
param("speed_r", 0.0, { min = -2.0, max = 2.0, step = 0.01, widget = "slider", unit = "rad/s", doc = "rotational speed" })
param("stop_d", 30, { doc = "stop when a sensor value exceeds this" })
function on_execute() target:write { vx = config.speed_x, va = config.speed_r } end)");
    INFO(rig.component->script().memory());
    CHECK(rig.component->script().memory() < 20000);
}
