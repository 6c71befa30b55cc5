// Hot reload in a running system: what is kept, what is new, and that a bad version changes nothing.
#include "tests/unit/lua/reload_rig.hpp"

using namespace nezumi;

TEST_CASE("a reload keeps a state with a hundred thousand links", "[lua][reload]") {
    ReloadRig world;
    const Text text =
        "param('x', 1) function on_activated() for i = 1, 100000 do state.list = { next = state.list, i = i } end end";
    // Its duration does not matter here: the watchdog limits the time of a script.
    world.write("links.lua", text);
    REQUIRE(world.add("links", "links.lua", {}, Budget{20.0}).state() == LifeState::active);
    CHECK(world.change("links.lua", text + "\nfunction on_reload() local n, l = 0, state.list while l do n, l = n + 1, "
                                           "l.next end assert(n == 100000) end") == "");
}

TEST_CASE("a reload with a state that is too large is refused, and the old version continues", "[lua][reload]") {
    ReloadRig world;
    const Text text = "function on_activated() for i = 1, 300000 do state[i] = {} end end";
    world.write("large.lua", text);
    ScriptComponent& it = world.add("large", "large.lua", {}, Budget{20.0});
    REQUIRE(it.state() == LifeState::active);
    CHECK(world.change("large.lua", text + " -- saved")
              .find("the new version can't take over the state, so the old version continues: a copy can have at "
                    "most 250000 values") != Text::npos);
    CHECK(it.state() == LifeState::active);
    CHECK(it.version() == 1);
}

TEST_CASE("a component can be reloaded from a text without a file", "[lua][reload]") {
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
