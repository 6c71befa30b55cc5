// Parameters and their sets in a reload: what is kept, what is left.
#include "engine/values/value_text.hpp"
#include "tests/unit/lua/reload_rig.hpp"

using namespace nezumi;

TEST_CASE("a reload reports kept values that differ from the new defaults", "[lua][reload]") {
    ReloadRig world;
    ScriptComponent& it =
        world.add_text("it", "param('hand', 1.0) param('system', 1) param('moved', 1) param('free', 1)");
    it.configured = {{"system", std::int64_t{5}}, {"moved", std::int64_t{6}}};
    REQUIRE(it.parameters().set_all(it.configured));
    REQUIRE(it.parameters().set("hand", 2.0));
    // What the system file gave goes without saying, unless the file's author has just changed the default.
    CHECK(world.change("it.lua", "param('hand', 1.0) param('system', 1) param('moved', 9) param('free', 9)") == "");
    CHECK(world.said("it: changed parameters are kept: hand = 2.0 (its default is 1.0), moved = 6 (its default is 9)"));
    CHECK_FALSE(world.said("system = 5"));
    CHECK_FALSE(world.said("free ="));
    world.log.clear();
    it.parameters().follow_default("hand");
    CHECK(world.change("it.lua", "param('hand', 3.0) param('system', 1) param('moved', 9)") == "");
    CHECK_FALSE(world.said("keeps what was set"));
}
