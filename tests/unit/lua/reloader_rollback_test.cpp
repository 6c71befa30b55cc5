// A new version that fails soon after, and going back by hand.
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
    CHECK(it.parameters().find("p")->value == ParameterValue(std::int64_t{5}));
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
