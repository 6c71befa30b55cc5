// Parameters and their sets in a reload: what is kept, what is left.
#include "engine/values/value_text.hpp"
#include "tests/unit/lua/reload_rig.hpp"

using namespace nezumi;

TEST_CASE("a set parameter is kept while name, type and bounds fit, an unset one follows the new default",
          "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text(
        "it",
        "param('set', 1.0) param('unset', 1) param('typed', 1) param('bound', 5.0) param('gone', 1) param('same', 1)");
    for (const auto& [name, value] :
         ParameterValues{{"set", 2.0}, {"typed", std::int64_t{2}}, {"bound", 4.0}, {"gone", std::int64_t{2}}}) {
        REQUIRE(it.parameters().set(name, value));
    }
    CHECK(world.change("it.lua",
                       "param('set', 9.0) param('unset', 7) param('typed', 'text') param('bound', 1.0, { max = 3 }) "
                       "param('same', 1)") == "");
    const auto value = [&](const Text& name) { return lua_text(it.parameters().find(name)->value); };
    CHECK(value("set") == "2.0");
    CHECK(value("unset") == "7");
    CHECK(value("typed") == "\"text\"");
    CHECK(value("bound") == "1.0");
    CHECK(it.parameters().find("gone") == nullptr);
    CHECK(world.said("it: parameter 'typed': its value 2 no longer fits, it is the default \"text\" now"));
    CHECK(world.said("it: parameter 'bound': its value 4.0 no longer fits, it is the default 1.0 now"));
    CHECK(world.said("it: parameter 'gone' went, and its value 2 with it"));
    REQUIRE(it.parameters().set("unset", std::int64_t{3}));
    CHECK(world.change("it.lua", "param('unset', 8) param('set', 1.0)") == "");
    CHECK(value("unset") == "3");
}

TEST_CASE("a set that a reload makes unfit is in use no more, and its parameters have the config's values",
          "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", "param('p', 1) param('q', 0.5) param('hand', 1) param('free', 1)");
    it.configured = {{"p", std::int64_t{2}}};
    it.sets = {{"far", {{"p", std::int64_t{9}}, {"q", 1.5}, {"hand", std::int64_t{3}}}}};
    REQUIRE(it.parameters().set_all(it.configured));
    REQUIRE(it.use("far"));
    REQUIRE(it.parameters().set_all({{"hand", std::int64_t{7}}, {"free", std::int64_t{8}}}));
    const auto value = [&](const Text& name) { return lua_text(it.parameters().find(name)->value); };
    const Text params = "param('q', 0.5) param('hand', 1) param('free', 1) ";
    CHECK(world.change("it.lua", params + "param('p', 1, { max = 20 })") == "");
    CHECK(it.set_in_use() == "far");
    CHECK(value("p") == "9");
    // The top level too must see the values that hold from then on.
    const Text narrow = params + "param('p', 1, { max = 5 }) state.q = config.q function on_execute() end";
    CHECK(world.change("it.lua", narrow) == "");
    CHECK(
        world.said("it: set 'far' no longer fits, and none is in use now: parameter 'p' (integer): 9 is above its "
                   "maximum 5"));
    CHECK_FALSE(world.said("its value 9 no longer fits"));
    CHECK(it.set_in_use().empty());
    CHECK(value("p") == "2");
    CHECK(value("q") == "0.5");
    CHECK(value("hand") == "7");
    CHECK(value("free") == "8");
    CHECK_FALSE(it.use("far"));
    // Nor does a value of the config that is unfit keep it to a set.
    REQUIRE(world.change("it.lua", params + "param('p', 1, { max = 1 })") == "");
    REQUIRE(it.use("default"));
    CHECK(value("p") == "1");
}

TEST_CASE("a reload says which values it kept and what their defaults are now, where that may surprise",
          "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it =
        world.add_text("it", "param('hand', 1.0) param('system', 1) param('moved', 1) param('free', 1)");
    it.configured = {{"system", std::int64_t{5}}, {"moved", std::int64_t{6}}};
    REQUIRE(it.parameters().set_all(it.configured));
    REQUIRE(it.parameters().set("hand", 2.0));
    // What the system file gave goes without saying, unless the file's author has just changed the default.
    CHECK(world.change("it.lua", "param('hand', 1.0) param('system', 1) param('moved', 9) param('free', 9)") == "");
    CHECK(world.said("it: keeps what was set: hand = 2.0 (its default is 1.0), moved = 6 (its default is 9)"));
    CHECK_FALSE(world.said("system = 5"));
    CHECK_FALSE(world.said("free ="));
    world.log.clear();
    it.parameters().follow_default("hand");
    CHECK(world.change("it.lua", "param('hand', 3.0) param('system', 1) param('moved', 9)") == "");
    CHECK_FALSE(world.said("keeps what was set"));
}
