// A file as a component: its life, its words, its commands and modules.
#include <filesystem>

#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

using Text = std::string;

// A list of what ran, kept by the script.
const Text life = R"(
local out = output("out", "TimedString")
local ran = ""
local function note(name) ran = ran .. name .. " " end
function on_activated() note("activated") end
function on_execute() note("execute") out:write(ran) if ran:find("fail") then error("failed") end end
function on_deactivated() note("deactivated") end
function on_aborting() note("aborting") out:write(ran) end
function on_error() note("error") out:write(ran) end
function on_reset() note("reset") end
command("fail", function() note("fail") end)
)";

Value number(std::int64_t value) { return value; }

}  // namespace

TEST_CASE("a file is a component type that is named after it", "[lua][component]") {
    CHECK(ScriptRig("param('x', 1)").component->type() == "RobotController");
    CHECK(ScriptRig("param('x', 1)", {}, "marker_follower2.lua").component->type() == "MarkerFollower2");
    CHECK(ScriptRig("param('x', 1)", {}, "my-own behavior.lua").component->type() == "MyOwnBehavior");
    CHECK(ScriptRig("param('x', 1)").component->name() == "controller");
    CHECK(ScriptRig("param('x', 1)").component->version() == 1);
}

TEST_CASE("a component of a script goes through OpenRTM's states", "[lua][component]") {
    ScriptRig rig(life);
    auto& out = rig.out<Text>("out");
    CHECK(rig.status() == "INACTIVE");
    rig.tick();
    CHECK(out.read() == "");  // nothing runs while INACTIVE
    rig.activate().tick();
    CHECK(out.read() == "activated execute ");
    REQUIRE(rig.component->deactivate(rig.now));
    rig.activate().tick();
    CHECK(out.read() == "activated execute deactivated activated execute ");
    REQUIRE(rig.component->call_command("fail", {}, rig.now));
    rig.tick();
    CHECK(rig.status() == "ERROR");
    CHECK(out.read() == "activated execute deactivated activated execute fail execute aborting ");
    rig.tick(2);
    CHECK(out.read() == "activated execute deactivated activated execute fail execute aborting error error ");
    REQUIRE(rig.component->reset(rig.now));
    CHECK(rig.status() == "INACTIVE");
}

TEST_CASE("callbacks are optional", "[lua][component]") {
    ScriptRig rig("input('in', 'TimedLong')");
    rig.activate().tick(3);
    CHECK(rig.status() == "ACTIVE");
    REQUIRE(rig.component->deactivate(rig.now));
    CHECK(rig.log.empty());
}

TEST_CASE("locals and state are kept from one activation to the next, unread values are not", "[lua][component]") {
    ScriptRig rig(R"(
local from = input("from", "TimedLong", "", { queue = 9 })
local out = output("out", "TimedLongSeq")
local runs = 0
function on_execute()
  runs = runs + 1
  state.runs = (state.runs or 0) + 1
  out:write { runs, state.runs, from.is_new and 1 or 0 }
end)");
    rig.activate();
    rig.feed("from", std::int32_t{1});
    rig.tick();
    REQUIRE(rig.component->deactivate(rig.now));
    rig.activate().tick();
    CHECK(rig.out<std::vector<std::int32_t>>("out").read() == std::vector<std::int32_t>{2, 2, 0});
}

TEST_CASE("an error keeps locals, state and parameters, and empties the in-ports at the reset", "[lua][component]") {
    ScriptRig rig(R"(
local from = input("from", "TimedLong", "", { queue = 9 })
local out = output("out", "TimedLongSeq")
param("bad", true)
local runs = 0
function on_execute()
  runs = runs + 1
  state.runs = runs
  if config.bad then error("bad") end
  out:write { runs, state.runs, from.is_new and 1 or 0 }
end)");
    rig.activate().tick();
    rig.feed("from", std::int32_t{1});
    rig.tick();
    REQUIRE(rig.component->parameters().set("bad", false));
    REQUIRE(rig.component->reset(rig.now));
    rig.activate().tick();
    CHECK(rig.out<std::vector<std::int32_t>>("out").read() == std::vector<std::int32_t>{2, 2, 0});
}

TEST_CASE("now and dt are simulated time", "[lua][component]") {
    ScriptRig rig(R"(
local out = output("out", "TimedDoubleSeq")
local at_load = dt
function on_execute() out:write { now(), dt, at_load } end)");
    rig.now = {50, 0.5};
    rig.activate().tick();
    CHECK(rig.out<std::vector<double>>("out").read() == std::vector<double>{0.5, 0.01, 0.01});
    rig.now.tick += 9;
    rig.now.seconds = 0.6;
    rig.tick();
    CHECK(rig.out<std::vector<double>>("out").read()[1] == Approx(0.1));
}

TEST_CASE("print is log.info, and log has four levels", "[lua][component]") {
    ScriptRig rig(
        "function on_execute() print('a', 1, nil) log.debug('d') log.info(1.5, true) log.warn('w') log.error('e') end");
    rig.activate().tick();
    CHECK(rig.log == std::vector<Text>{"info: a\t1\tnil", "debug: d", "info: 1.5\ttrue", "warn: w", "error: e"});
    CHECK(failure_of("", "log.warning('x')") == "robot_controller.lua:3: log has no 'warning' (did you mean 'warn'?)");
    CHECK(failure_of("", "log.wran('x')") == "robot_controller.lua:3: log has no 'wran' (did you mean 'warn'?)");
    CHECK(failure_of("", "log.warn = print") == "robot_controller.lua:3: can't set 'log.warn': 'log' is read-only");
}

TEST_CASE("print and log show tables, ports and parameters as people read them", "[lua][component]") {
    ScriptRig rig(
        "local range = input('range', 'TimedShortSeq') param('gains', { 1.0, 0.5 })\n"
        "function on_execute() print(range:read(), range, config.gains, config) log.warn({ x = 1 }, 'then', { 2 }) "
        "end");
    rig.activate().feed<std::vector<std::int16_t>>("range", {3, 1});
    rig.tick();
    CHECK(rig.log ==
          std::vector<Text>{"info: { 3, 1 }\tinput 'range' (TimedShortSeq)\t{ 1.0, 0.5 }\t{ gains = { 1.0, 0.5 } }",
                            "warn: { x = 1 }\tthen\t{ 2 }"});
}

TEST_CASE("what a file prints while it loads is not lost, at the start and in a reload", "[lua][component]") {
    ScriptRig rig("param('x', 1) print('first')");
    CHECK(rig.log == std::vector<Text>{"info: first"});
    rig.log.clear();
    std::vector<ScriptFile> required;
    ScriptComponent::Loading loading = rig.component->next_loading();
    loading.source = source("param('x', 1) print('loaded') log.warn('careful')");
    auto loaded = ScriptComponent::load_beside(loading, required);
    REQUIRE(loaded);
    auto next = rig.component->prepare(loading, std::move(*loaded), rig.now, required);
    REQUIRE(next);
    REQUIRE(rig.component->adopt(*next, rig.now));
    rig.component->commit(std::move(*next), 1);
    CHECK(rig.log == std::vector<Text>{"info: loaded", "warn: careful"});
}

TEST_CASE("about tells of the file", "[lua][component]") {
    ScriptRig rig("about { version = '1.2', vendor = 'me', category = 'test' } param('x', 1)");
    CHECK(rig.component->script().about().version == "1.2");
    CHECK(rig.component->script().about().vendor == "me");
    CHECK(rig.component->script().about().category == "test");
    CHECK(refusal("about { vresion = '1' }") ==
          "robot_controller.lua:1: about: unknown option 'vresion' (did you mean 'version'?)");
    CHECK(refusal("about { version = 1 }") ==
          "robot_controller.lua:1: about: option 'version' expected a text, got number");
    CHECK(refusal("about 'me'") == "robot_controller.lua:1: about expected a table, got string");
    CHECK(refusal("about {} about {}") == "robot_controller.lua:1: about is given twice");
}

TEST_CASE("a command runs in the component's own state with copies of its arguments", "[lua][component][command]") {
    ScriptRig rig(R"(
local out = output("out", "TimedString")
local total = 0
command("add", function(n, list) total = total + n + #(list or {}) return total, { total = total } end, "adds")
command("say", function(text) out:write(text) end)
command("odd", function() return print end)
command("bad", function() out:write("lost") error("no") end)
function on_execute() end)");
    const PlainData arguments{.values = {number(2), TableRef{0}},
                              .tables = {{{number(1), Text("a")}, {number(2), Text("b")}}}};
    auto results = rig.component->call_command("add", arguments, rig.now);
    REQUIRE(results);
    CHECK(results->values == std::vector<Value>{number(4), TableRef{0}});
    CHECK(results->tables == std::vector<PlainData::Table>{{{Text("total"), number(4)}}});
    CHECK(rig.component->commands()[0].doc == "adds");

    CHECK(describe(rig.component->call_command("say", {.values = {Text("hi")}, .tables = {}}, rig.now).error()) ==
          "robot_controller.lua:5: output 'out': controller is INACTIVE and can't write: activate it first");
    rig.activate();
    REQUIRE(rig.component->call_command("say", {.values = {Text("hi")}, .tables = {}}, rig.now));
    CHECK(describe(rig.component->call_command("bad", {}, rig.now).error()) == "robot_controller.lua:7: no");
    rig.tick();
    CHECK(rig.out<Text>("out").read() == "hi");
    CHECK(rig.status() == "ACTIVE");  // a command that fails is no failed execution

    CHECK(describe(rig.component->call_command("ad", {}, rig.now).error()) ==
          "unknown command 'ad' (did you mean 'add'?)");
    CHECK(describe(rig.component->call_command("odd", {}, rig.now).error()) ==
          "robot_controller.lua:6: command 'odd': result 1 is a function, and only plain data can be returned");
    CHECK(describe(rig.component->call_command("add", {}, rig.now).error()) ==
          "robot_controller.lua:4: attempt to perform arithmetic on a nil value (local 'n')");
}

TEST_CASE("an endless command ends by its budget and the component goes on", "[lua][component][command][watchdog]") {
    ScriptRig rig("command('loop', function() while true do end end) function on_execute() end");
    rig.activate();
    auto result = rig.component->call_command("loop", {}, rig.now);
    REQUIRE_FALSE(result);
    CHECK(result.error().kind == Error::Kind::out_of_time);
    CHECK(result.error().message == "ran for more than 0.1 s: is there an endless loop?");
    rig.tick();
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("a budget that is used up is told apart from other errors", "[lua][component][watchdog]") {
    ScriptRig rig("function on_execute() while true do end end", {.budget = {0.02}});
    rig.activate().tick();
    CHECK(rig.status() == "ERROR");
    CHECK(rig.component->last_error().kind == Error::Kind::out_of_time);
    CHECK(rig.error() == "robot_controller.lua:1: ran for more than 0.02 s: is there an endless loop?");
}

TEST_CASE("a failed execution and its on_aborting share one budget", "[lua][component][watchdog]") {
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

TEST_CASE("modules are required by name, once each", "[lua][component][modules]") {
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

    CHECK(refusal("require 'c'", context) == "robot_controller.lua:1: require 'c': there is no module 'c'");
    CHECK(refusal("\nrequire 'bad'", context).substr(0, 13) == "bad.lua:2: un");
    CHECK(refusal("require 'slip'", context) == "slip.lua:2:25: unknown global 'xx' (did you mean 'x'?)");
    CHECK(refusal("require 'hook'", context) ==
          "hook.lua:1:10: 'on_execute' can't be used in a module: callbacks belong into the component's own file");
    CHECK(refusal("require 'fails'", context) ==
          "fails.lua:2: attempt to index a nil value (local 't') (called from robot_controller.lua:1)");
    CHECK(refusal("require(3)", context) == "robot_controller.lua:1: require expected a module's name, got number");
    CHECK(refusal("require 'cycle1'", context) ==
          "cycle2.lua:1: require 'cycle1': the modules require each other: cycle1 requires cycle2 requires cycle1 "
          "(called from robot_controller.lua:1)");
    CHECK(refusal("pcall(require, 'fails') pcall(require, 'fails') param('x', 1)", context) == "");
    for (const std::string name : {"fails", "bad", "c", "cycle1"}) {
        CAPTURE(name);
        const std::string after = " function on_execute() end";
        CHECK(refusal("pcall(require, '" + name + "')" + after, context) == "");
        CHECK(refusal("coroutine.resume(coroutine.create(require), '" + name + "')" + after, context) == "");
    }
    CHECK(refusal("require 'a'") == "robot_controller.lua:1: require 'a': there are no modules here");
    ScriptRig late("function on_execute() require 'a' end", context);
    late.activate().tick();
    CHECK(late.error() ==
          "robot_controller.lua:1: require 'a': modules are loaded while the file loads; require it at its top");
}

TEST_CASE("an error in a module names the line of the behaviour that called it", "[lua][component][modules]") {
    const ModuleFinder find = [&](std::string_view name, std::string_view) -> Expected<SourceText> {
        if (name == "inner") return source("return { index = function(t)\n return t.x.y end }", "inner.lua");
        return source(
            "local inner = require 'inner'\nlocal M = {}\nfunction M.index(t)\n local y = inner.index(t)\n return y "
            "end\n"
            "function M.refuse(t)\n error('expected a table', 2) end\nfunction M.call(f)\n f() end\n"
            "function M.deep(n)\n if n == 0 then error('the end') end M.deep(n - 1) return 1 end\n"
            "function M.raise(value)\n error(value) end\nreturn M",
            "outer.lua");
    };
    const auto error_of = [&](const Text& body) {
        ScriptRig rig("local outer = require 'outer'\nlocal out = output('out', 'TimedLong')\nfunction on_execute()\n" +
                          body + "\nend",
                      {.find_module = find});
        rig.activate().tick();
        return rig.error();
    };
    CHECK(error_of("outer.index({})") ==
          "inner.lua:2: attempt to index a nil value (field 'x') (called from robot_controller.lua:4)");
    CHECK(error_of("local function f()\n outer.index({}) end\n f()") ==
          "inner.lua:2: attempt to index a nil value (field 'x') (called from robot_controller.lua:5)");
    // Whose mistake it is, its line is told alone.
    CHECK(error_of("outer.refuse(1)") == "robot_controller.lua:4: expected a table");
    CHECK(error_of("outer.call(function()\n error('mine') end)") == "robot_controller.lua:5: mine");
    CHECK(error_of("outer.deep(5000)") == "outer.lua:11: the end (called from robot_controller.lua:4)");
    CHECK(error_of("outer.raise(nil)") == "outer.lua:13: an error of value nil");
    // A coroutine has a stack of its own; who resumed it is not on it.
    CHECK(error_of("local co = coroutine.wrap(function()\n outer.index({}) end)\n co()")
              .find("inner.lua:2: attempt to index a nil value (field 'x')") != Text::npos);
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

TEST_CASE("a component of a script is small", "[lua][component]") {
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
