// A new version that fails soon after, and going back by hand.
#include "engine/values/value_text.hpp"
#include "tests/unit/lua/reload_rig.hpp"

using namespace nezumi;

TEST_CASE("a version that fails within its first 10 executions goes back, state included, and no tick is lost",
          "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    world.tick(5);
    CHECK(world.change("it.lua", counter("100", "state.broken = true") + "local run = on_execute\n")
              .find("still running") == Text::npos);
    world.tick(1);
    CHECK(world.out<Longs>("it.out") == Longs{1, 105});
    CHECK(world.change("it.lua",
                       "local out = output('out', 'TimedLongSeq') local n = 0\nfunction on_execute() n = n + 1 "
                       "state.total = 0 out:write { 0, 0 } if n == 10 then error('late') end end") == "");
    CHECK(it.version() == 3);
    world.tick(9);
    CHECK(world.out<Longs>("it.out") == Longs{0, 0});
    const auto published = it.find_out_port("out")->count();
    world.tick();
    CHECK(it.version() == 2);
    CHECK(to_text(it.state()) == "ACTIVE");
    CHECK(world.out<Longs>("it.out") == Longs{2, 205});  // in the very tick that failed
    CHECK(it.find_out_port("out")->count() == published + 1);
    CHECK(world.said("it: version 3 failed in execution 10 of its first 10: it.lua:2: late; back to version 2 in it"));
    CHECK(world.change("it.lua", counter("1")) == "");
    CHECK(it.version() == 4);
}

TEST_CASE("the version before takes the tick of one that fails, however much of its time that has used",
          "[lua][reload][wallclock]") {
    ReloadRig world;
    world.write("it.lua", counter("1"));
    ScriptComponent& it = world.add("it", "it.lua", {}, Budget{0.4});
    world.tick(5);
    const Text slow = GENERATE(as<Text>(), "", "for i = 1, 30000000 do n = i end");  // a third of it
    CHECK(world.change("it.lua", "local out = output('out', 'TimedLongSeq') local n = 0\nfunction on_execute() " +
                                     slow + " error('late') end") == "");
    world.tick();
    CHECK(it.version() == 1);
    CHECK(world.out<Longs>("it.out") == Longs{6, 6});
    CHECK(it.script().context().budget.seconds == 0.4);
}

TEST_CASE("a failure after the first 10 executions is an error like any other", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    world.tick();
    CHECK(world.change("it.lua",
                       "local n = 0\nfunction on_execute() n = n + 1 if n == 11 then error('late') end end") == "");
    world.tick(10);
    CHECK(to_text(it.state()) == "ACTIVE");
    world.tick();
    CHECK(to_text(it.state()) == "ERROR");
    CHECK(it.version() == 2);
}

TEST_CASE("a version on probation that changed the ports goes back with its connections", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it =
        world.add_text("it", "local a = output('a', 'TimedLong')\nfunction on_execute() a:write(1) end");
    ScriptComponent& sink = world.add_text("sink", "input('from', 'TimedLong')");
    REQUIRE(world.system.connect("it.a", "sink.from"));
    world.tick();
    CHECK(world.change("it.lua", "local b = output('b', 'TimedLong')\nfunction on_execute() b:write('x') end") == "");
    CHECK_FALSE(sink.find_in_port("from")->connected());
    world.tick();
    CHECK(it.version() == 1);
    CHECK(to_text(it.state()) == "ACTIVE");
    CHECK(it.find_out_port("b") == nullptr);
    CHECK(sink.find_in_port("from")->connected());
    world.tick(2);
    CHECK(sink.find_in_port("from")->arrival_tick() == world.system.now().tick - 1);
}

TEST_CASE("when one component fails on probation, the others of the reload go back with it", "[lua][reload]") {
    ReloadRig world;
    world.write("twin.lua",
                "param('bad', false)\nlocal out = output('out', 'TimedLong')\nfunction on_execute() out:write(1) end");
    ScriptComponent& one = world.add("one", "twin.lua");
    ScriptComponent& two = world.add("two", "twin.lua", {{"bad", true}});
    CHECK(world.change("twin.lua",
                       "param('bad', false)\nlocal out = output('out', 'TimedLong')\nfunction on_execute() assert(not "
                       "config.bad, 'no') out:write(2) end") == "");
    world.tick();
    CHECK(one.version() == 1);
    CHECK(two.version() == 1);
    world.tick();
    CHECK(world.out<std::int32_t>("one.out") == 1);
    CHECK(world.said(
        "two: version 2 failed in execution 1 of its first 10: twin.lua:3: no; back to version 1 in two, one"));
}

TEST_CASE("rollback goes back by hand, state included, and parameters keep what was set", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1", "param('p', 1)"));
    CHECK(describe(world.reloader.rollback(it).error()) ==
          "it has no version before this one; still running version 1");
    world.tick(2);
    CHECK(world.change("it.lua", counter("100", "param('p', 1) param('q', 1)")) == "");
    REQUIRE(it.parameters().set("p", std::int64_t{5}));
    world.tick(20);
    auto report = world.reloader.rollback(it);
    REQUIRE(report);
    CHECK(report->version == 1);
    CHECK(report->components == std::vector<Text>{"it"});
    world.tick();
    CHECK(world.out<Longs>("it.out") == Longs{3, 3});
    CHECK(it.parameters().find("p")->value == Value(std::int64_t{5}));
    CHECK(it.parameters().find("q") == nullptr);
}

TEST_CASE("rollback goes back step by step, as far as versions are kept", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    for (int i = 2; i <= 12; ++i) CHECK(world.change("it.lua", counter(std::to_string(i))) == "");
    CHECK(it.version() == 12);
    for (int version = 11; version >= 4; --version) {
        REQUIRE(world.reloader.rollback(it));
        CHECK(it.version() == version);
        world.tick();
    }
    CHECK(describe(world.reloader.rollback(it).error()) ==
          "it has no version before this one; still running version 4");
    CHECK(world.change("it.lua", counter("1")) == "");
    CHECK(it.version() == 13);  // a number is given once
}

TEST_CASE("connections that come again after a slip or a roll-back keep their order", "[lua][reload]") {
    ReloadRig world;
    const auto source = [](const Text& value) {
        return "local out = output('out', 'TimedLong')\nfunction on_execute() out:write(" + value + ") end\n";
    };
    ScriptComponent& first = world.add_text("first", source("1"));
    world.add_text("second", source("2"));
    ScriptComponent& sink = world.add_text("sink", "input('from', 'TimedLong')");
    REQUIRE(world.system.connect("first.out", "sink.from"));
    REQUIRE(world.system.connect("second.out", "sink.from"));
    world.tick(2);
    CHECK(world.out<std::int32_t>("sink.from") == 2);
    const Text text = GENERATE(as<Text>(), "local o = output('slip', 'TimedLong')\nfunction on_execute() end\n",
                               "function on_execute() error('x') end\n");
    CHECK(world.change("first.lua", text) == "");
    world.tick(12);
    if (first.version() != 1) CHECK(world.change("first.lua", source("1")) == "");
    world.tick(2);
    CHECK(world.system.peers(*sink.find_in_port("from")) == std::vector<Text>{"first.out", "second.out"});
    CHECK(world.out<std::int32_t>("sink.from") == 2);
}

TEST_CASE("a version that a roll-back brings back during its own probation is still on probation", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    const auto failing_in = [](const Text& execution) {
        return "local n = 0\nfunction on_execute() n = n + 1 if n == " + execution + " then error('late') end end\n";
    };
    world.tick(2);
    CHECK(world.change("it.lua", failing_in("8")) == "");
    world.tick(3);
    CHECK(world.change("it.lua", failing_in("3")) == "");
    world.tick(3);
    CHECK(it.version() == 2);
    world.tick(6);
    CHECK(it.version() == 1);
    CHECK(to_text(it.state()) == "ACTIVE");
    CHECK(world.said("it: version 2 failed in execution 8 of its first 10: it.lua:2: late; back to version 1 in it"));
}

TEST_CASE("a version that comes back and fails in the same tick goes back as well", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", counter("1"));
    const auto failing_in = [](const Text& execution) {
        return "local out = output('out', 'TimedLongSeq') local n = 0\nfunction on_execute() n = n + 1 if n == " +
               execution + " then error('late') end end\n";
    };
    world.tick(2);
    CHECK(world.change("it.lua", failing_in("4")) == "");
    world.tick(3);
    CHECK(world.change("it.lua", failing_in("2")) == "");
    world.tick(2);
    CHECK(it.version() == 1);
    CHECK(to_text(it.state()) == "ACTIVE");
    CHECK(world.out<Longs>("it.out") == Longs{3, 3});  // in the very tick
    CHECK(world.said("it: version 3 failed in execution 2 of its first 10: it.lua:2: late; back to version 1 in it"));
    CHECK(world.said("it: version 2 failed in execution 4 of its first 10: it.lua:2: late; back to version 1 in it"));
}

TEST_CASE("a parameter that was set from outside during probation outlives the roll-back, the version's own does not",
          "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", "param('k', 1) param('own', 1)\n" + counter("1"));
    world.tick(2);
    CHECK(world.change("it.lua",
                       "param('k', 1) param('own', 1)\nlocal n = 0\nfunction on_execute() n = n + 1 config.own = 7 "
                       "if n == 6 then error('late') end end\n") == "");
    world.tick(3);
    REQUIRE(it.parameters().set("k", std::int64_t{30}));
    world.tick(6);
    CHECK(it.version() == 1);
    CHECK(it.parameters().find("k")->value == Value(std::int64_t{30}));
    CHECK(it.parameters().find("own")->value == Value(std::int64_t{1}));
}

namespace {

// k = 7 by the system, k = 50 by the set that is in use.
struct SetRig : ReloadRig {
    SetRig() {
        it.configured = {{"k", std::int64_t{7}}};
        it.sets = {{"big", {{"k", std::int64_t{50}}}}, {"small", {{"k", std::int64_t{2}}}}};
        REQUIRE(it.parameters().set_all(it.configured));
        REQUIRE(it.use("big"));
    }
    // Reloads a version with this parameter that fails in its second execution.
    void fail(const Text& parameter, const std::function<void()>& meanwhile = {}) {
        REQUIRE(change("it.lua",
                       parameter +
                           "\nlocal n = 0 function on_execute() n = n + 1 if n == 2 then error('no') end end") == "");
        CHECK(it.set_in_use().empty());
        tick();
        if (meanwhile) meanwhile();
        tick();
        CHECK(it.version() == 1);
    }
    Text k() const { return lua_text(it.parameters().find("k")->value) + " " + it.set_in_use(); }

    ScriptComponent& it = add_text("it", "param('k', 1, { max = 100 })\nfunction on_execute() end");
};

}  // namespace

TEST_CASE("a roll-back in probation brings back the set that was in use, with its values", "[lua][reload]") {
    SetRig world;
    world.fail("param('k', 1, { max = 40 })");
    CHECK(world.k() == "50 big");
    world.fail("param('q', 1)");
    CHECK(world.said("it: parameter 'k' went, and its value 50 with it"));
    CHECK_FALSE(world.said("its value 7 with it"));
    CHECK(world.k() == "50 big");
}

TEST_CASE("unread messages that a version on probation had no room for are back with the version before",
          "[lua][reload]") {
    ReloadRig world;
    const Text ports = "local out = output('out', 'TimedLongSeq') local from = input('from', 'TimedLong', ''";
    ScriptComponent& it =
        world.add_text("it", ports +
                                 ", { queue = 10 }) param('go', false) function on_execute() if not config.go then "
                                 "return end local all = {} while from.is_new do all[#all + 1] = "
                                 "from:read() end out:write(all) end");
    for (std::int32_t i = 1; i <= 5; ++i) it.find_in_port("from")->inject(i);
    world.tick();
    const std::size_t queue = GENERATE(0, 2);
    CHECK(world.change("it.lua", ports + (queue == 0 ? "" : ", { queue = 2 }") +
                                     ") function on_execute() error('no') end") == "");
    CHECK(it.find_in_port("from")->dropped() == (queue == 0 ? 4 : 3));
    CHECK(world.said(queue == 0
                         ? "it: input 'from' has no queue now: the oldest 4 of 5 unread messages were dropped"
                         : "it: input 'from' has a queue of 2 now: the oldest 3 of 5 unread messages were dropped"));
    world.tick();
    CHECK(it.version() == 1);
    CHECK(it.find_in_port("from")->dropped() == 0);
    REQUIRE(it.parameters().set("go", true));
    world.tick();
    CHECK(world.out<Longs>("it.out") == Longs{1, 2, 3, 4, 5});
}

TEST_CASE("what somebody chose during probation outlives the roll-back: a set, a value", "[lua][reload]") {
    SetRig world;
    world.fail("param('k', 1, { max = 40 })", [&] { REQUIRE(world.it.parameters().set("k", std::int64_t{30})); });
    CHECK(world.k() == "30 big");
    REQUIRE(world.it.use("big"));
    world.fail("param('k', 1, { max = 40 })", [&] { REQUIRE(world.it.use("small")); });
    CHECK(world.k() == "2 small");
}

TEST_CASE("rollback by hand brings back a set that the reload left", "[lua][reload]") {
    SetRig world;
    REQUIRE(world.change("it.lua", "param('k', 1, { max = 40 })\nfunction on_execute() end") == "");
    world.tick(20);
    CHECK(world.k() == "7 ");
    REQUIRE(world.reloader.rollback(world.it));
    CHECK(world.k() == "50 big");
}

TEST_CASE("a value that the script itself set since the reload outlives a rollback by hand, and none in probation",
          "[lua][reload]") {
    SetRig world;
    const Text sets_k = "param('k', 1, { max = 40 }) local n = 0 function on_execute() config.k = 30 n = n + 1 ";
    REQUIRE(world.change("it.lua", sets_k + "end") == "");
    world.tick(20);
    CHECK(world.k() == "30 ");
    REQUIRE(world.reloader.rollback(world.it));
    CHECK(world.k() == "30 big");
    REQUIRE(world.it.use("big"));
    REQUIRE(world.change("it.lua", sets_k + "if n == 2 then error('no') end end") == "");
    world.tick(2);
    CHECK(world.it.version() == 1);
    CHECK(world.k() == "50 big");
}

TEST_CASE("a version that goes back keeps no value of a set that somebody has left meanwhile", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it =
        world.add_text("it", "param('speed', 0.1) param('turn', 1.0) param('hand', 1)\nfunction on_execute() end");
    it.sets = {{"fast", {{"speed", 0.4}}}, {"wide", {{"turn", 2.0}, {"hand", std::int64_t{3}}}}};
    REQUIRE(it.use("fast"));
    REQUIRE(it.parameters().set("hand", std::int64_t{7}));
    const auto values = [&] {
        Text text;
        for (const auto& parameter : it.parameters().all()) text += lua_text(parameter.value) + " ";
        return text + it.set_in_use();
    };
    const Text set = GENERATE(as<Text>(), "default", "wide");
    // Also where the version that fails has no such parameter, or has set it itself.
    const Text speed = GENERATE(as<Text>(), "param('speed', 0.1) local function own() end",
                                "param('speed', 0.1) local function own() if n > 1 then config.speed = 0.9 end end",
                                "local function own() end");
    CAPTURE(set, speed);
    REQUIRE(world.change("it.lua", "local n = 0 " + speed +
                                       " param('turn', 1.0) param('hand', 1)\nfunction on_execute() n = n + 1 own() "
                                       "if n == 5 then error('no') end end") == "");
    world.tick();
    REQUIRE(it.use(set));
    const bool by_hand = GENERATE(false, true);
    world.tick(by_hand ? 1 : 4);
    if (by_hand) REQUIRE(world.reloader.rollback(it));
    CHECK(it.version() == 1);
    CHECK(values() == (set == "wide" ? "0.1 2.0 3 wide" : "0.1 1.0 1 "));
}

TEST_CASE("what was set from outside during a probation outlives its roll-back after a rollback by hand within it",
          "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", "param('k', 1)\n" + counter("1"));
    world.tick(2);
    const Text failing =
        "param('k', 1) local n = 0\nfunction on_execute() n = n + 1 if n == 4 then error('late') end end";
    REQUIRE(world.change("it.lua", failing) == "");
    REQUIRE(it.parameters().set("k", std::int64_t{5}));
    world.tick(2);
    REQUIRE(world.change("it.lua", "param('k', 1)\n" + counter("1")) == "");
    world.tick();
    REQUIRE(world.reloader.rollback(it));
    CHECK(it.version() == 2);
    world.tick(2);
    CHECK(it.version() == 1);
    CHECK(it.parameters().find("k")->value == Value(std::int64_t{5}));
}

TEST_CASE("components of one file that fail alike are told in one line", "[lua][reload]") {
    ReloadRig world;
    world.write("all.lua", counter("1"));
    for (const char* name : {"b1", "b2", "b3"}) world.add(name, "all.lua");
    world.tick();
    CHECK(world.change("all.lua", "function on_execute() error('x') end") == "");
    world.log.clear();
    world.tick(3);
    std::vector<Text> told;
    for (const Text& line : world.log) {
        if (line.find("failed") != Text::npos) told.push_back(line);
    }
    REQUIRE(told.size() == 1);
    CHECK(told[0].ends_with(
        "b1, b2, b3: version 2 failed in execution 1 of its first 10: all.lua:1: x; back to version 1 in "
        "b1, b2, b3"));
}
