// Calls that the clock ended: a replay ends them where the run did, and finds what they left.
#include <catch2/catch.hpp>
#include <string>

#include "tests/unit/file_text.hpp"
#include "tests/unit/journal/random_run.hpp"
#include "tests/unit/journal/small_run.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

TEST_CASE("a call that timed out ends at the same point in the replay", "[journal][watchdog]") {
    SmallRun it(R"(
local out = output("out", "TimedLong")
param("endless", false)
local n = 0
command("hang", function() while true do end end)
function on_execute()
  n = n + 1
  out:write(n)
  while config.endless do end
end
)",
                Budget{0.02});
    it.tick(5);
    CHECK_FALSE(it.live->act(Command{"it", "hang", {}}, {}));
    it.tick(5);
    REQUIRE(it.live->act(SetParameter{"it", "endless", true}, {}));
    it.tick(5);
    CHECK(it.live->system().find("it")->state() == LifeState::error);
    REQUIRE(it.live->act(SetParameter{"it", "endless", false}, {}));
    REQUIRE(it.live->act(Reset{"it"}, {}));
    REQUIRE(it.live->act(Activate{"it"}, {}));
    it.tick(5);
    const std::uint64_t hash = it.end();
    CHECK_THAT(text_of_file(it.file), Contains("out_of_time"));

    SECTION("although it is endless") {
        const Replayed again = replay(it.file);
        CHECK(again.error.empty());
        CHECK(hash_text(again.hash) == hash_text(hash));
    }
    SECTION("although it would end by itself there") {
        std::string text = text_of_file(it.file);
        for (std::string_view endless : {"while config.endless do", "while true do"}) {
            const auto at = text.find(endless);
            REQUIRE(at != std::string::npos);
            text.replace(at, endless.size(), "while false do");
        }
        it.folder.write("it.journal", text);
        const Replayed again = replay(it.file);
        CHECK(again.error.empty());
        CHECK(hash_text(again.hash) == hash_text(hash));
    }
}

TEST_CASE("a call that the clock ended leaves the state that it left in the run, in the replay too",
          "[journal][watchdog]") {
    SmallRun it(R"(
local out = output("out", "TimedLongSeq")
local from = input("from", "TimedLongSeq")
param("go", false)
param("gains", { 7, 8 })
state.k = 0
state.list = { 1, 2, deep = { n = 0 } }
local list, deep = state.list, state.list.deep
state.again = list
command("hang", function() while true do list[1] = list[1] + 1 end end)
function on_execute()
  state.last = state.last or from:read()
  state.gains = config.gains
  while config.go do
    state.last = from:read()
    state.last[1] = state.k
    state.gains = { state.k }
    state.k = state.k + 1
    deep.n = deep.n + 1
    list[2] = nil
    list[#list + 1] = state.k < 5 and 7 or nil
  end
  out:write { state.k, state.list.deep.n, deep.n, #list, list[1], state.again == list and 1 or 0,
              #state.last > 0 and state.last[1] or 0, config.gains[1] }
end
)",
                Budget{0.02});
    it.tick(5);
    REQUIRE(it.live->act(SetParameter{"it", "go", true}, {}));
    it.tick(5);
    CHECK(it.live->system().find("it")->state() == LifeState::error);
    REQUIRE(it.live->act(SetParameter{"it", "go", false}, {}));
    REQUIRE(it.live->act(Reset{"it"}, {}));
    REQUIRE(it.live->act(Activate{"it"}, {}));
    it.tick(5);
    CHECK_FALSE(it.live->act(Command{"it", "hang", {}}, {}));
    it.tick(5);
    const auto written = it.live->system().port("it.out").value()->value().get<std::vector<std::int32_t>>();
    CHECK(written[0] > 100);
    CHECK(written[4] > 100);
    const std::uint64_t hash = it.end();
    const Replayed again = replay(it.file);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}

TEST_CASE("a replay that becomes another run reports the calls that timed out, and the state that was not kept",
          "[journal][watchdog]") {
    const auto [left, lost] = GENERATE(table<std::string, std::string>(
        {{"", ""},
         {"state.f = print", ", nor all of its state: state.f is a function"},
         {"state.m = require('native.matrix') { { 1 } }", ", nor all of its state: state.m is a matrix"},
         {"for i = 1, 5000 do state[i] = i end",
          ", nor all of its state: state has more than 4000 values or 64 kB of text"}}));
    SmallRun it("local out = output('out', 'TimedDouble')\nlocal n = 0\n" + left +
                    "\ncommand('hang', function() while true do n = n + 1 end end)\n"
                    "function on_execute() out:write(n) end",
                Budget{0.02});
    it.tick(5);
    CHECK_FALSE(it.live->act(Command{"it", "hang", {}}, {}));
    it.tick(5);
    it.journal->mark();
    it.end();
    CHECK_THAT(replay(it.file).error,
               EndsWith("; in the run, a call of it ran out of time at tick 5 of start 1, and the "
                        "journal does not have the locals that it left" +
                        lost));
}

TEST_CASE("a version on probation that the clock ended is taken back in the replay too", "[journal][watchdog]") {
    SmallRun it(counter, Budget{0.02});
    it.tick(5);
    const std::string endless = "while n % 2 == 1 do end";
    const std::string slow = "local out = output('out', 'TimedLong')\nlocal n = 0\nfunction on_execute() n = n + 1 " +
                             endless + " out:write(-1) error('late') end\n";
    it.folder.write("behaviors/it.lua", slow);
    REQUIRE(it.live->act(Reload{.files = {it.folder.path("behaviors/it.lua").string()}}, {}));
    it.tick(2);
    const auto* component = it.live->system().find("it");
    CHECK(component->state() == LifeState::active);
    CHECK(component->version() == 1);
    it.tick(5);
    const std::uint64_t hash = it.end();
    CHECK_THAT(text_of_file(it.file), Contains("out_of_time"));

    SECTION("although it is endless") {}
    SECTION("although it would fail by itself there") {
        std::string text = text_of_file(it.file);
        const auto at = text.find(endless);
        REQUIRE(at != std::string::npos);
        it.folder.write("it.journal", text.replace(at, endless.size(), ""));
    }
    const Replayed again = replay(it.file);
    CHECK(again.error.empty());
    CHECK(hash_text(again.hash) == hash_text(hash));
}
