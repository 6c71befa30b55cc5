// Hot reload in a running system: what is kept, what is new, and that a bad version changes nothing.
#include "tests/unit/lua/reload_rig.hpp"

using namespace nezumi;

TEST_CASE("a reload keeps state and makes locals new, without losing a tick", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& counted = world.add_text("counted", counter("1"));
    world.tick(3);
    CHECK(world.out<Longs>("counted.out") == Longs{3, 3});
    CHECK(world.change("counted.lua", counter("100")) == "");
    CHECK(counted.version() == 2);
    world.tick();
    CHECK(world.out<Longs>("counted.out") == Longs{1, 103});
    CHECK(counted.find_out_port("out")->count() == 4);  // one message in each tick
    CHECK(world.said("counted.lua: version 2 runs in counted"));
}

TEST_CASE("state keeps plain data with its shape, and drops the rest with a warning that names its path",
          "[lua][reload]") {
    ReloadRig world;
    world.add_text("keeper", R"(
local out = output('out', 'TimedLong')
function on_activated()
  local shared = { n = 1 }
  state.a = { shared, shared, b = function() end, deep = { co = coroutine.create(print), port = out, x = 1.5 } }
  state.loop = { text = "t\0t" } state.loop.self = state.loop
  state[false] = true state[1.5] = "x"
  state.object = setmetatable({ v = 1 }, { __index = {} })
end)");
    world.tick();
    CHECK(world.change("keeper.lua", R"(
local out = output('out', 'TimedLong')
local seen_at_load = state.a ~= nil
function on_reload()
  assert(seen_at_load)
  assert(state.a[1] == state.a[2] and state.a[1].n == 1 and state.a.b == nil and state.a.deep.x == 1.5)
  assert(state.a.deep.co == nil and state.a.deep.port == nil)
  assert(state.loop.self == state.loop and state.loop.text == "t\0t")
  assert(state[false] == true and state[1.5] == "x" and state.object.v == 1 and getmetatable(state.object) == nil)
end)") == "");
    CHECK(world.said("keeper: state.a.b is a function: it was dropped, state keeps plain data"));
    CHECK(world.said("keeper: state.a.deep.co is a coroutine: it was dropped"));
    CHECK(world.said("keeper: state.a.deep.port is a port or another object of the engine: it was dropped"));
    CHECK(world.said("keeper: state.object is a table with a metatable: only its plain data was kept"));
}

TEST_CASE("a state of a hundred thousand links is carried over", "[lua][reload]") {
    ReloadRig world;
    const Text text =
        "param('x', 1) function on_activated() for i = 1, 100000 do state.list = { next = state.list, i = i } end end";
    // What it takes is no matter here: the time of a script is the watchdog's.
    world.write("links.lua", text);
    REQUIRE(world.add("links", "links.lua", {}, Budget{20.0}).state() == LifeState::active);
    CHECK(world.change("links.lua", text + "\nfunction on_reload() local n, l = 0, state.list while l do n, l = n + 1, "
                                           "l.next end assert(n == 100000) end") == "");
}

TEST_CASE("a state that is too large to be carried over refuses the reload, and the old version runs on",
          "[lua][reload]") {
    ReloadRig world;
    const Text text = "function on_activated() for i = 1, 300000 do state[i] = {} end end";
    world.write("large.lua", text);
    ScriptComponent& it = world.add("large", "large.lua", {}, Budget{20.0});
    REQUIRE(it.state() == LifeState::active);
    CHECK(world.change("large.lua", text + " -- saved")
              .find("state can't be taken over, and the old version runs on: it holds more than 250000 values") !=
          Text::npos);
    CHECK(it.state() == LifeState::active);
    CHECK(it.version() == 1);
}

TEST_CASE("a reload refuses what a load refuses, and the version before goes on", "[lua][reload]") {
    ReloadRig world;
    world.add_text("c", "param('speed', 1)\n" + counter("1"));
    world.tick();
    CHECK(world.change("c.lua", "param('speed', 1)\n" + counter("config.sped"))
              .find("c.lua:7:45: config: unknown parameter 'sped' (did you mean 'speed'?)") != Text::npos);
    CHECK(world.change("c.lua", counter("math.flor(1)"))
              .find("c.lua:6:43: unknown field 'math.flor' (did you mean 'math.floor'?)") != Text::npos);
    world.tick();
    CHECK(world.out<Longs>("c.out") == Longs{2, 2});
}

TEST_CASE("of many values that a reload kept five are named", "[lua][reload]") {
    ReloadRig world;
    Text text;
    for (int i = 1; i <= 7; ++i) text += "param('p" + std::to_string(i) + "', 0) ";
    ScriptComponent& it = world.add_text("it", text);
    for (int i = 1; i <= 7; ++i) REQUIRE(it.parameters().set("p" + std::to_string(i), std::int64_t{i}));
    CHECK(world.change("it.lua", text + "-- changed") == "");
    CHECK(world.said("p5 = 5 (its default is 0) and 2 more"));
    CHECK_FALSE(world.said("p6 ="));
}

TEST_CASE("unread values of in-ports are kept, also when the queue changes its length", "[lua][reload]") {
    ReloadRig world;
    const auto text = [](int queue) {
        return "local from = input('from', 'TimedLong', '', { queue = " + std::to_string(queue) +
               " })\nlocal out = output('out', 'TimedLong')\nparam('go', false)\nfunction on_execute() if config.go "
               "then out:write(from:read()) end end";
    };
    ScriptComponent& it = world.add_text("it", text(5));
    for (std::int32_t i = 1; i <= 4; ++i) it.find_in_port("from")->inject(i);
    world.tick();
    Port* const before = it.find_in_port("from");
    CHECK(world.change("it.lua", text(3)) == "");
    CHECK(it.find_in_port("from") == before);
    REQUIRE(it.parameters().set("go", true));
    for (const std::int32_t expected : {2, 3, 4}) {
        world.tick();
        CHECK(world.out<std::int32_t>("it.out") == expected);
    }
}

TEST_CASE("on_activated does not run again; on_reload does, with the version before", "[lua][reload]") {
    ReloadRig world;
    const Text text = R"(
local out = output('out', 'TimedString')
local from = input('from', 'TimedLong')
local text = "fresh"
function on_activated() text = "activated" end
function on_reload(old) text = "from " .. old .. " with " .. from:read() end
function on_execute() out:write(text) end)";
    ScriptComponent& it = world.add_text("it", text);
    it.find_in_port("from")->inject(std::int32_t{7});
    world.tick();
    CHECK(world.out<Text>("it.out") == "activated");
    CHECK(world.change("it.lua", text + " ") == "");
    CHECK(it.find_in_port("from")->is_new());  // on_reload may look, and consumes nothing
    world.tick();
    CHECK(world.out<Text>("it.out") == "from 1 with 7");
    CHECK(world.change("it.lua", text) == "");
    world.tick();
    CHECK(world.out<Text>("it.out") == "from 2 with 7");
}

TEST_CASE("the error about a local that a reload has lost says so", "[lua][reload]") {
    ReloadRig world;
    const auto text = [](const Text& more) {
        return "local out = output('out', 'TimedLong')\nlocal map\nfunction on_activated() map = {} end\nfunction "
               "on_execute() map.x = 1 end" +
               more;
    };
    ScriptComponent& it = world.add_text("it", text(""));
    world.tick();
    CHECK(world.change("it.lua", text("\n")) == "");
    world.tick();
    CHECK(
        world.said("version 2 failed in execution 1 of its first 10: it.lua:4: attempt to index a nil value (upvalue "
                   "'map'); a reload makes "
                   "the file's locals new and does not run on_activated again: set it at the top of the file or in "
                   "on_reload, or keep it in "
                   "`state`; back to version 1 in it"));
    CHECK(it.version() == 1);
    CHECK(to_text(it.state()) == "ACTIVE");
}

TEST_CASE("a version that can't be had leaves the old one untouched and says what runs", "[lua][reload][watchdog]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    world.tick(2);
    const Text still = "; still running version 1";
    CHECK(world.change("it.lua", "function on_execute( end") ==
          "it.lua:1: <name> or '...' expected near 'end'" + still);
    CHECK(world.change("it.lua", "") ==
          "it.lua: the file declares nothing: no port, parameter, command, task or callback" + still);
    CHECK(world.change("it.lua", counter("1").substr(0, 90)).find(still) != Text::npos);
    CHECK(world.change("it.lua", counter("1") + "taget = 1") ==
          "it.lua:9:1: unknown global 'taget' (declare it first: local taget)" + still);
    CHECK(world.change("it.lua", counter("1") + "error('no')") == "it.lua:9: no" + still);
    CHECK(world.change("it.lua", counter("1") + "while true do end") ==
          "it.lua:9: ran for more than 0.05 s: is there an endless loop?" + still);
    CHECK(world.change("it.lua", counter("1") + "state.total = 1000 error('no')") == "it.lua:9: no" + still);
    CHECK(world.change("it.lua", counter("1") + "function on_reload() state.total = 1000 error('no') end") ==
          "it.lua:9: no" + still);
    CHECK(world.change("it.lua", counter("1") + "function on_reload() out:write { 5 } end") ==
          "it.lua:9: output 'out': on_reload can't write; the next execution can" + still);
    CHECK(world.change("it.lua", counter("1") + "function on_reload() while true do end end") ==
          "it.lua:9: ran for more than 0.05 s: is there an endless loop?" + still);
    fs::remove(world.path("it.lua"));
    CHECK(describe(world.reload({world.path("it.lua")}).error()).find(still) != Text::npos);
    world.tick();
    CHECK(world.out<Longs>("it.out") == Longs{3, 3});
    CHECK(it.version() == 1);
    CHECK(it.parameters().all().empty());
}

TEST_CASE("all components of a file go together or not at all", "[lua][reload]") {
    ReloadRig world;
    world.write("twin.lua", "param('bad', false)");
    ScriptComponent& one = world.add("one", "twin.lua");
    ScriptComponent& two = world.add("two", "twin.lua", {{"bad", true}});
    world.write("other.lua", "param('x', 1)");
    ScriptComponent& other = world.add("other", "other.lua");
    CHECK(world.change("twin.lua", "param('bad', false)\nif config.bad then error('not with this') end") ==
          "twin.lua:2: not with this; still running version 1");
    CHECK(one.version() == 1);
    CHECK(world.change("twin.lua", "param('bad', true)\nfunction on_reload() assert(not config.bad, 'bad') end") ==
          "twin.lua:2: bad; still running version 1");
    CHECK(one.version() == 1);
    CHECK(two.version() == 1);
    CHECK(world.change("twin.lua", "param('bad', false) param('more', 1)") == "");
    CHECK(one.version() == 2);
    CHECK(two.version() == 2);
    CHECK(other.version() == 1);
}

TEST_CASE("a changed module takes along everything that requires it", "[lua][reload][modules]") {
    ReloadRig world;
    world.write("inner.lua", "return 1");
    world.write("outer.lua", "return { n = require 'inner' }");
    const Text user =
        "local m = require 'outer'\nlocal out = output('out', 'TimedLong')\nfunction on_execute() out:write(m.n) end";
    ScriptComponent& a = world.add_text("a", user);
    ScriptComponent& b = world.add_text("b", user + "\n");
    ScriptComponent& c = world.add_text("c", "param('x', 1)");
    world.tick();
    CHECK(world.change("inner.lua", "return 2") == "");
    world.tick();
    CHECK(world.out<std::int32_t>("a.out") == 2);
    CHECK(world.out<std::int32_t>("b.out") == 2);
    CHECK(a.version() == 2);
    CHECK(c.version() == 1);
    CHECK(world.change("inner.lua", "return = 2") ==
          "inner.lua:1: unexpected symbol near '='; still running version 2");
    CHECK(world.change("inner.lua", "return 40000000000") == "");
    world.tick();  // fails in both: neither keeps it
    CHECK(a.version() == 2);
    CHECK(b.version() == 2);
    world.tick();
    CHECK(world.out<std::int32_t>("b.out") == 2);
}

TEST_CASE("what runs after a module has changed is said for each file and version", "[lua][reload][modules]") {
    ReloadRig world;
    world.write("m.lua", "return 1");
    world.add_text("a", "local m = require 'm' function on_execute() end");
    world.add_text("b", "local m = require 'm' function on_execute() end");
    CHECK(world.change("b.lua", "local m = require 'm' function on_execute() log.info(m) end") == "");
    CHECK(world.change("m.lua", "return 2") == "");
    CHECK(world.said("a.lua: version 2 runs in a"));
    CHECK(world.said("b.lua: version 3 runs in b"));
}

TEST_CASE("connections stay where ports fit, and a port that goes is reported with its peers", "[lua][reload]") {
    ReloadRig world;
    const auto source = [](const Text& port, const Text& type, const Text& value) {
        return "local out = output('" + port + "', '" + type +
               "')\nlocal n = 0\nfunction on_execute() n = n + 1 out:write(" + value + ") end";
    };
    world.add_text("source", source("out", "TimedLong", "n"));
    ScriptComponent& sink = world.add_text("sink",
                                           "local from = input('from', 'TimedLong')\nlocal out = output('seen', "
                                           "'TimedLong')\nfunction on_execute() out:write(from:read()) end");
    REQUIRE(world.system.connect("source.out", "sink.from"));
    world.tick(2);
    CHECK(world.change("source.lua", source("out", "TimedLong", "n + 100")) == "");
    CHECK(world.notes.empty());
    world.tick(2);
    CHECK(world.out<std::int32_t>("sink.seen") == 101);

    CHECK(world.change("source.lua", source("outt", "TimedLong", "n + 200")) == "");
    CHECK(world.notes == std::vector<Text>{"source.out went; it was connected to sink.from"});
    CHECK(world.system.connections().empty());
    world.tick(2);
    CHECK(world.out<std::int32_t>("sink.seen") == 102);  // the last that came
    CHECK_FALSE(sink.find_in_port("from")->connected());

    CHECK(world.change("source.lua", source("out", "TimedDouble", "n + 300")) == "");
    CHECK(world.notes == std::vector<Text>{"source.outt went; it was not connected"});
    CHECK(world.change("source.lua", source("out", "TimedLong", "n + 400")) == "");
    CHECK(world.notes == std::vector<Text>{"source.out is TimedLong now, not TimedDouble; it was not connected",
                                           "source.out is connected to sink.from again"});
    world.tick(2);
    CHECK(world.out<std::int32_t>("sink.seen") == 401);

    CHECK(world.change("source.lua", source("out", "TimedDouble", "n")) == "");
    CHECK(world.notes ==
          std::vector<Text>{"source.out is TimedDouble now, not TimedLong; it was connected to sink.from"});
    CHECK(world.change("sink.lua", "param('x', 1)") == "");
    CHECK(world.notes ==
          std::vector<Text>{"sink.from went; it was not connected", "sink.seen went; it was not connected"});
    world.tick(2);
}

TEST_CASE("a port that was an input for a while gets back its connection as an output", "[lua][reload]") {
    ReloadRig world;
    const Text sends = "local port = output('port', 'TimedLong') function on_execute() port:write(1) end";
    world.add_text("it", sends);
    world.add_text("other", "local from = input('from', 'TimedLong') function on_execute() end");
    REQUIRE(world.system.connect("it.port", "other.from"));
    CHECK(world.change("it.lua", "local port = input('port', 'TimedLong') function on_execute() end") == "");
    CHECK(world.notes == std::vector<Text>{"it.port is an input now; it was connected to other.from"});
    CHECK(world.change("it.lua", sends) == "");
    CHECK(world.notes.back() == "it.port is connected to other.from again");
    world.tick(2);
    CHECK(world.out<std::int32_t>("other.from") == 1);
}

TEST_CASE("a component in ERROR gets on_reset and on_activated with the new code", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it =
        world.add_text("it", "local out = output('out', 'TimedString')\nfunction on_execute() error('old') end");
    world.tick();
    CHECK(to_text(it.state()) == "ERROR");
    CHECK(
        world.change(
            "it.lua",
            "local out = output('out', 'TimedString')\nlocal ran = ''\nfunction on_reset() ran = ran .. 'reset ' end\n"
            "function on_activated() ran = ran .. 'activated ' end\nfunction on_execute() out:write(ran) end") == "");
    CHECK(to_text(it.state()) == "ACTIVE");
    world.tick();
    CHECK(world.out<Text>("it.out") == "reset activated ");
}

TEST_CASE("an INACTIVE component stays INACTIVE through a reload", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    REQUIRE(it.deactivate(world.system.now()));
    CHECK(world.change("it.lua", counter("2")) == "");
    CHECK(to_text(it.state()) == "INACTIVE");
    CHECK(it.version() == 2);
}

TEST_CASE("changed_files tells what has changed on disk and nothing else", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& a = world.add_text("a", counter("1"));
    ScriptComponent& b = world.add_text("b", counter("1"));
    world.write("a.lua", counter("2"));
    auto report = world.reload_changed();
    REQUIRE(report);
    CHECK(report->components == std::vector<Text>{"a"});
    CHECK(a.version() == 2);
    CHECK(b.version() == 1);
    CHECK(changed_files(world.reloader.loaded_files(), read_source).empty());
}

TEST_CASE("a component reloads from a text that is in no file", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    world.tick();
    const SourceText text{it.script().file().path, "it.lua", counter("10")};
    REQUIRE(world.reload({}, text));
    world.tick();
    CHECK(world.out<Longs>("it.out") == Longs{1, 11});
    const auto refused = world.reload({}, {it.script().file().path, "it.lua", "function on_execute( end"});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "<name> or '...' expected near 'end'; still running version 2");
    CHECK(refused.error().place == Place{"it.lua", 1});
}

TEST_CASE("each version has random numbers of its own", "[lua][reload]") {
    ReloadRig world;
    const Text text =
        "local out = output('out', 'TimedDouble')\nlocal r = math.random()\nfunction on_execute() out:write(r) end";
    world.add_text("it", text);
    world.tick();
    const double first = world.out<double>("it.out");
    CHECK(world.change("it.lua", text + "\n") == "");
    world.tick();
    CHECK(world.out<double>("it.out") != first);
}

TEST_CASE("values that a script set for the next tick survive a reload in between", "[lua][reload]") {
    ReloadRig world;
    const Text text =
        "param('n', 1)\nlocal out = output('out', 'TimedLong')\nfunction on_execute() out:write(config.n) config.n = "
        "config.n + 1 end";
    world.add_text("it", text);
    world.tick();
    CHECK(world.change("it.lua", text + "\n") == "");
    world.tick();
    CHECK(world.out<std::int32_t>("it.out") == 2);
}
