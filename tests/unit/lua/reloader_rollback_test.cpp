// A new version that fails soon after, and going back by hand.
#include "engine/values/value_text.hpp"
#include "tests/unit/lua/reload_rig.hpp"

using namespace nezumi;

TEST_CASE("the version before runs in the tick of a failed one, even if no time is left", "[lua][reload][wallclock]") {
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

TEST_CASE("unread messages that a shorter queue dropped are back when the version goes back", "[lua][reload]") {
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

TEST_CASE("a version that goes back has no values of a parameter set that was left meanwhile", "[lua][reload]") {
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
