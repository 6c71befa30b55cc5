// Parameters as scripts declare, read and set them.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

TEST_CASE("config.x = v in a script is effective from the next tick, in every state and at every rate",
          "[lua][parameters]") {
    const auto value = [](const ScriptRig& rig) { return rig.component->parameters().find("x")->value; };
    const auto set = [](ScriptRig& rig, std::int64_t to) {
        PlainData arguments;
        arguments.values.emplace_back(to);
        REQUIRE(rig.component->call_command("give", arguments, rig.now));
    };
    const std::string text = "param('x', 1)\ncommand('give', function(v) config.x = v end)\n";
    ScriptRig inactive(text);
    set(inactive, 44);
    CHECK(value(inactive) == Value(std::int64_t{1}));
    inactive.component->latch_inputs(inactive.now);
    CHECK(value(inactive) == Value(std::int64_t{44}));

    ScriptRig broken(text + "function on_execute() error('x') end function on_aborting() config.x = 5 end\n");
    broken.activate().tick();
    CHECK(broken.status() == "ERROR");
    broken.component->latch_inputs(broken.now);
    CHECK(value(broken) == Value(std::int64_t{5}));
}
