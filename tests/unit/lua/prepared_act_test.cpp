// Acts in two phases: what was prepared ticks ago is performed as if it were prepared now, or refused.
#include "engine/live/prepared_act.hpp"

#include <catch2/catch.hpp>
#include <thread>

#include "tests/unit/live_rig.hpp"

using namespace nezumi;

namespace {

std::string counting(const std::string& top, const std::string& step) {
    return "local out = output('out', 'TimedDoubleSeq')\nparam('gain', 1)\n" + top +
           "\nfunction on_execute()\n  state.n = (state.n or 0) + 1\n  out:write { state.n, " + step + " }\nend\n";
}

struct TwoPhases : LiveRig {
    explicit TwoPhases(const std::string& script)
        : LiveRig("behavior 'it' { script = 'it' }", {{"it", script}}),
          path(folder.path("behaviors/it.lua").string()) {}

    // As a worker does: in another thread.
    PreparedAct prepare(const Act& act) const {
        const Preparation preparation = live->prepare(act);
        PreparedAct prepared;
        std::thread([&] { prepared = preparation(); }).join();
        return prepared;
    }
    std::string error_of(PreparedAct prepared) const {
        const auto done = live->commit(std::move(prepared), {});
        return done ? "" : describe(done.error());
    }
    std::vector<double> out() const {
        return live->system().port("it.out").value()->value().get<std::vector<double>>();
    }

    std::string path;
};

constexpr auto changed = "the system has changed while the files were read: try again";

}  // namespace

TEST_CASE("a prepared reload takes over the state at the commit", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    it.tick(3);
    it.folder.write("behaviors/it.lua", counting("", "7"));
    PreparedAct prepared = it.prepare(Reload{.files = {it.path}});
    it.tick(4);
    CHECK(it.error_of(std::move(prepared)).empty());
    it.tick();
    CHECK(it.out() == std::vector<double>{8, 7});
}

TEST_CASE("a top level that reads state or the time runs in the tick of the commit", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    it.tick(3);
    const char* const top = GENERATE("local at = state.n", "local kept = state local at = kept.n",
                                     "local at = math.floor(now() * 100 + 0.5)");
    it.folder.write("behaviors/it.lua", counting(top, "at"));
    PreparedAct prepared = it.prepare(Reload{.files = {it.path}});
    it.tick(4);
    it.folder.write("behaviors/it.lua", "a later save");
    CHECK(it.error_of(std::move(prepared)).empty());
    it.tick();
    CHECK(it.out() == std::vector<double>{8, 7});
}

TEST_CASE("a top level that needs a state does not fail with an empty one", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    it.tick(3);
    it.folder.write("behaviors/it.lua", counting("local next = state.n + 1", "next"));
    PreparedAct prepared = it.prepare(Reload{.files = {it.path}});
    CHECK_FALSE(prepared.error);
    CHECK(it.error_of(std::move(prepared)).empty());
    it.tick();
    CHECK(it.out() == std::vector<double>{4, 4});
}

TEST_CASE("the top level reads a parameter that was set during loading", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    it.folder.write("behaviors/it.lua", counting("local gain = config.gain", "gain"));
    PreparedAct prepared = it.prepare(Reload{.files = {it.path}});
    REQUIRE(it.live->act(SetParameter{"it", "gain", 3.0}, {}));
    CHECK(it.error_of(std::move(prepared)).empty());
    it.tick();
    CHECK(it.out() == std::vector<double>{1, 3});
}

TEST_CASE("a reload is refused after another reload, another behaviour or a restart", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    PreparedAct prepared = it.prepare(Reload{.files = {it.path}});
    REQUIRE(it.live->fits(prepared));
    const std::vector<Act> acts{Reload{.component = "it", .text = counting("", "1")},
                                Add{BehaviorEntry{.name = "other", .script = "it", .path = it.path}}, Remove{"it"},
                                Restart{}};
    REQUIRE(it.live->act(acts[GENERATE(0U, 1U, 2U, 3U)], {}));
    CHECK_FALSE(it.live->fits(prepared));
    CHECK(it.error_of(std::move(prepared)) == changed);
}

TEST_CASE("an act reads each file once, so all scripts have the same text", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    it.folder.write("behaviors/it.lua", counting("local step = require 'step'", "step"));
    it.folder.write("behaviors/step.lua", "return 5");
    PreparedAct prepared = it.prepare(Restart{});
    it.folder.write("behaviors/step.lua", "return 6");
    it.folder.write("behaviors/it.lua", "a later save");
    CHECK(it.error_of(std::move(prepared)).empty());
    it.tick();
    CHECK(it.out() == std::vector<double>{1, 5});
}

TEST_CASE("the commit reports an error of the preparation, and nothing has changed", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    it.tick();
    it.folder.write("behaviors/it.lua", "function on_execute( end");
    CHECK_THAT(it.error_of(it.prepare(Reload{.files = {it.path}})),
               Catch::EndsWith("it.lua:1: <name> or '...' expected near 'end'; still running version 1"));
    CHECK_THAT(it.error_of(it.prepare(Restart{})), Catch::EndsWith("it.lua:1: <name> or '...' expected near 'end'"));
    CHECK(it.live->starts() == 1);
    it.folder.write("system.lua", "robot('mouse')");
    CHECK_FALSE(it.error_of(it.prepare(Restart{})).empty());
    it.tick();
    CHECK(it.out() == std::vector<double>{2, 0});
}

TEST_CASE("a restart reports the components of acts that it would lose", "[lua][prepare]") {
    TwoPhases it(counting("", "0"));
    REQUIRE(it.live->act(Add{BehaviorEntry{.name = "other", .script = "it", .path = it.path}}, {}));
    CHECK(it.prepare(Restart{}).lost == std::vector<std::string>{"other"});
    it.folder.write("system.lua", "behavior 'other' { script = 'it' }");
    CHECK(it.prepare(Restart{}).lost.empty());
}
