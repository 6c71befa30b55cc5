// Going back in a running simulation: states, branches, and what follows.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/values/walk.hpp"
#include "tests/unit/lua/past_rig.hpp"

using namespace nezumi;

TEST_CASE("a system that goes back has its earlier state to the last bit, and runs on as it did before",
          "[lua][past]") {
    PastRig it;
    std::vector<std::uint64_t> hashes{it.live->trace_hash()};
    for (int i = 0; i < 500; ++i) {
        if (i == 120) it.set_speed(0.2);
        if (i == 200) it.act(Command{"keeper", "kick", {}});
        if (i == 300) it.act(Use{"keeper", "fast"});
        if (i == 333) it.act(Teleport{"mouse", {{-0.5, 0.2}, 1.0}});
        it.tick();
        hashes.push_back(it.live->trace_hash());
    }
    for (const int tick : {250, 500, 0, 1, 333, 120, 334, 499}) {
        INFO(tick);
        REQUIRE(it.seek(tick) == "");
        CHECK(it.live->system().now().tick == tick);
        CHECK(it.live->trace_hash() == hashes[static_cast<std::size_t>(tick)]);
        CHECK(it.live->is_past() == (tick < 500));
    }
    REQUIRE(it.seek(100) == "");
    for (std::size_t tick = 101; tick <= 500; ++tick) {
        it.tick();
        CHECK(it.live->trace_hash() == hashes[tick]);
    }
    CHECK_FALSE(it.live->is_past());
    CHECK(it.live->history().branches().size() == 1);
    CHECK_FALSE(it.live->differs());
    it.tick();  // after its end, the run goes on
    CHECK(it.live->system().now().tick == 501);
}

TEST_CASE("an act in the past begins a branch, and the old future can be gone to", "[lua][past]") {
    PastRig it;
    it.tick(300);
    const std::uint64_t main_end = it.live->trace_hash();
    REQUIRE(it.seek(150) == "");
    it.set_speed(-0.3);
    CHECK(it.live->history().branches().size() == 2);
    CHECK_FALSE(it.live->is_past());
    it.tick(50);
    const std::uint64_t branch_end = it.live->trace_hash();
    CHECK(branch_end != main_end);
    REQUIRE(it.seek(-1, "main") == "");
    CHECK(it.live->trace_hash() == main_end);
    CHECK(it.live->system().now().tick == 300);
    REQUIRE(it.seek(-1, "branch 1") == "");
    CHECK(it.live->trace_hash() == branch_end);
    // The start of a branch is that of its parent, and a branch can have branches.
    REQUIRE(it.seek(100, "branch 1") == "");
    CHECK(it.live->is_past());
    it.tick(60);
    it.set_speed(0.05);
    CHECK(it.live->history().branches().back().name == "branch 2");
    it.tick(40);
    const std::uint64_t second = it.live->trace_hash();
    REQUIRE(it.seek(-1, "main") == "");
    REQUIRE(it.seek(-1, "branch 2") == "");
    CHECK(it.live->trace_hash() == second);
}

TEST_CASE("an act that is refused in the past begins no branch", "[lua][past]") {
    PastRig it;
    it.tick(100);
    REQUIRE(it.seek(50) == "");
    CHECK_FALSE(it.live->act(SetParameter{"keeper", "speed", 7.0}, user));
    CHECK(it.live->is_past());
    CHECK(it.live->history().branches().size() == 1);
}

TEST_CASE("a past with other scripts runs those scripts, even if the files have changed", "[lua][past]") {
    PastRig it;
    it.tick(100);
    std::string later = past_behavior;
    later.replace(later.find("- 0.5"), 5, "- 0.9");
    it.folder.write("behaviors/busy.lua", later);
    it.act(Reload{});
    it.tick(100);
    const std::uint64_t end = it.live->trace_hash();
    it.folder.write("behaviors/busy.lua", "this is no Lua");
    it.folder.write("system.lua", "neither is this");
    REQUIRE(it.seek(50) == "");
    CHECK(it.live->system().find("keeper")->version() == 1);
    it.tick(150);
    CHECK(it.live->system().find("keeper")->version() == 2);
    CHECK(it.live->trace_hash() == end);
}

TEST_CASE("a past may be before a restart", "[lua][past]") {
    PastRig it;
    it.tick(130);
    const std::uint64_t first = it.live->trace_hash();
    it.act(Restart{});
    it.tick(70);
    const std::uint64_t second = it.live->trace_hash();
    REQUIRE(it.seek(Seek{.tick = 130, .start = 1}) == "");
    CHECK(it.live->starts() == 1);
    CHECK(it.live->trace_hash() == first);
    REQUIRE(it.seek(Seek{.tick = 0, .start = 2}) == "");
    CHECK(it.live->system().now().tick == 0);
    it.tick(70);
    CHECK(it.live->trace_hash() == second);
    REQUIRE(it.seek(Seek{.tick = 20}) == "");  // of the start that is now
    CHECK(it.live->starts() == 2);
}

TEST_CASE("a seek that is given up leaves the present untouched", "[lua][past]") {
    PastRig it;
    it.tick(200);
    const std::uint64_t now = it.live->trace_hash();
    {
        auto past = it.live->begin_seek({.tick = 150});
        REQUIRE(past);
        const auto there = (*past)->go_on(PastRun::Clock::now());
        REQUIRE(there);
        CHECK_FALSE(*there);
        CHECK((*past)->progress() < 1);
    }
    CHECK(it.live->trace_hash() == now);
    CHECK_FALSE(it.live->is_past());
    it.tick(10);
    PastRig same;
    same.tick(210);
    CHECK(it.live->trace_hash() == same.live->trace_hash());
}

TEST_CASE("a moment that never was is refused", "[lua][past]") {
    PastRig it;
    it.tick(100);
    CHECK(it.seek(101) == "main ends at 1 s: no later time can be reached");
    CHECK(it.seek(5, "other") == "there is no branch 'other': branches() lists them");
    CHECK(it.seek(Seek{.tick = 5, .start = 2}) == "main ends at 1 s: no later time can be reached");
    CHECK(it.seek(Seek{.tick = 5, .start = -1}) == "expected a start from 1 on, or 0 for the last one, got -1");
    const auto past = it.live->begin_seek({.tick = 50});
    REQUIRE(past);
    REQUIRE((*past)->go_on(PastRun::Clock::time_point::max()));
    it.act(Restart{});
    const auto done = it.live->commit(**past, user);
    REQUIRE_FALSE(done);
    CHECK(describe(done.error()) == "the system has changed while the past was computed: try again");
}

TEST_CASE("a system that others are connected with, or that has no file, does not go back", "[lua][past]") {
    const LiveRig it("rtm { export = {} }\nbehavior 'b' { script = 'b' }\n", {{"b", "function on_execute() end"}});
    CHECK(it.live->act(Seek{.tick = 0}, user).error().message ==
          "a system that is connected with other programs by 'rtm' can't go back in time");
    LiveOptions options;
    options.scripts = &lua_scripts();
    const auto live = RunningSystem::make(SystemSpec{}, Project::of("system.lua"), std::move(options));
    REQUIRE(live);
    CHECK((*live)->act(Seek{.tick = 0}, user).error().message == "a system without a file can't go back in time");
}

TEST_CASE("a past that becomes another one is refused with its tick, and the present stays", "[lua][past]") {
    // Its numbers do not depend on the run alone.
    class Counter final : public Device {
    public:
        explicit Counter(std::string name) : Device(std::move(name), "Counter") {}
        void sense(const Time& /*now*/) override { number_.write(++count()); }
        void actuate(const Time& /*now*/) override {}

    private:
        static std::int32_t& count() {
            static std::int32_t the = 0;
            return the;
        }
        OutPort<std::int32_t>& number_ = add_out_port<std::int32_t>("number");
    };
    const Scratch folder;
    LiveOptions options;
    options.scripts = &lua_scripts();
    options.components["Counter"]["sim"] = [](const ComponentEntry& entry, System&) {
        return Expected<std::unique_ptr<Component>>(std::make_unique<Counter>(entry.name));
    };
    const auto file = folder.write("system.lua", "component 'it' { type = 'Counter' }\n");
    const auto live = RunningSystem::load(file, std::move(options));
    INFO((live ? "" : describe(live.error())));
    REQUIRE(live);
    (*live)->activate();
    for (int i = 0; i < 250; ++i) (*live)->tick();
    const std::uint64_t now = (*live)->trace_hash();
    CHECK((*live)->act(Seek{.tick = 220}, user).error().message ==
          "the past can't be computed again: at tick 100 of start 1 the computed run differs from the original run");
    CHECK((*live)->trace_hash() == now);
    CHECK_FALSE((*live)->is_past());
}

TEST_CASE("a run that ends in the past is not compared with the ticks that followed", "[lua][past]") {
    PastRig it;
    it.tick(200);
    REQUIRE(it.seek(99) == "");
    it.live->end();
    it.tick(20);
    CHECK_FALSE(it.live->differs());
}

TEST_CASE("the points and markers of a time line are remembered once for each branch", "[lua][past]") {
    PastRig it;
    it.live->remember_run();
    it.tick(300);
    REQUIRE(it.seek(100) == "");
    it.tick(50);  // known already
    it.act(Teleport{"mouse", {{0.6, 0.0}, 0}});
    it.tick(100);
    const RememberedRun& run = *it.live->remembered();
    const RunHistory& history = it.live->history_until_now();
    const auto main = run.rows(history, 0, 1, 1000);
    REQUIRE(main.size() == 60);  // 20 a second
    CHECK(main.front().when.tick == 5);
    CHECK(main.back().when.tick == 300);
    const auto branch = run.rows(history, 1, 1, 1000);
    REQUIRE(branch.size() == 50);
    CHECK(branch.back().when.tick == 250);
    CHECK(branch[28].robots[0].x == main[28].robots[0].x);  // before the branch
    CHECK(branch[40].robots[0].x > main[40].robots[0].x + 0.2F);
    CHECK(run.rows(history, 1, 1, 10).size() == 10);
    CHECK(run.rows(history, 1, 2, 10).empty());
    CHECK(run.marks(history, 0, 1).empty());
    REQUIRE(run.marks(history, 1, 1).size() == 1);
    CHECK(run.marks(history, 1, 1)[0].text == "mouse touches box 1");
    CHECK(run.marks(history, 1, 1)[0].when.tick > 150);
}

TEST_CASE("the time line knows where a thing was before it moved and after, also where rows are left out",
          "[lua][past]") {
    PastRig it;
    it.live->remember_run();
    it.tick(100);
    const std::vector<ThingPose> things = std::as_const(*it.live).system().world()->things();
    std::size_t box = 0;
    while (things.at(box).name != "box 1") ++box;
    const double before = things[box].pose.position.x;
    it.act(MoveThing{"box 1", {{1.5, 0.5}, 0}});
    it.tick(100);
    const RunHistory& history = it.live->history_until_now();
    for (const std::size_t most : {1000, 7}) {
        std::vector<std::pair<std::int64_t, double>> places;
        for (const auto& row : it.live->remembered()->rows(history, 0, 1, most)) {
            for (const auto& thing : row.things) {
                CHECK(thing.index == box);
                places.emplace_back(row.when.tick, thing.pose.position.x);
            }
        }
        REQUIRE(places.size() == 2);
        CHECK(places[0].second == before);
        CHECK(places[1].second == 1.5);
        CHECK(places[1].first > 100);
        if (most == 1000) CHECK(places[0].first == 100);
    }
}

TEST_CASE("an error is a mark of the time line", "[lua][past]") {
    LiveRig it("behavior 'b' { script = 'b' }\n",
               {{"b", "function on_execute() if now() >= 0.1 then error('no') end end"}});
    it.live->remember_run();
    it.tick(50);
    const auto marks = it.live->remembered()->marks(it.live->history_until_now(), 0, 1);
    REQUIRE(marks.size() == 1);
    CHECK(marks[0].kind == RememberedRun::Mark::Kind::error);
    CHECK(marks[0].when.tick == 11);
    CHECK(marks[0].text.find("b: ") == 0);
}

TEST_CASE("random acts, seeks and branches lead to states that were there", "[lua][past]") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        INFO(seed);
        std::mt19937 random(seed);
        const auto below = [&](std::int64_t end) {
            return std::uniform_int_distribution<std::int64_t>(0, end - 1)(random);
        };
        PastRig it;
        std::map<std::pair<std::string, std::int64_t>, std::uint64_t> seen;
        const auto branch = [&] { return it.live->history().branches()[it.live->history().current()].name; };
        for (int i = 0; i < 60; ++i) {
            const std::int64_t what = below(10);
            if (what < 5) {
                for (std::int64_t ticks = below(40); ticks >= 0; --ticks) {
                    it.tick();
                    const auto [known, is_new] =
                        seen.try_emplace({branch(), it.live->system().now().tick}, it.live->trace_hash());
                    CHECK(known->second == it.live->trace_hash());
                }
            } else if (what == 5) {
                it.set_speed(static_cast<double>(below(100)) / 100);
            } else if (what == 6) {
                it.act(Command{"keeper", "kick", {}});
            } else if (what == 7) {
                it.act(Teleport{"mouse", {{-0.01 * static_cast<double>(below(80)), 0.3}, 1.0}});
            } else {
                const auto& branches = it.live->history_until_now().branches();
                const auto& to = branches[static_cast<std::size_t>(below(static_cast<std::int64_t>(branches.size())))];
                const std::string name = to.name;
                const std::int64_t tick = below(to.end.tick + 1);
                REQUIRE(it.seek(tick, name) == "");
                const auto known = seen.find({name, tick});
                if (known != seen.end()) CHECK(it.live->trace_hash() == known->second);
            }
        }
        CHECK_FALSE(it.live->differs());
    }
}

// The number of events that the present branch has kept.
std::size_t kept(const RunningSystem& live) { return live.history().branches().front().size(); }

TEST_CASE("messages from outside are kept up to a limit; beyond it, the past is given up and says so", "[lua][past]") {
    PastRig it;
    const Value picture(std::vector<short>(std::size_t{31} << 20));  // 62 MB
    for (int i = 0; i < 4; ++i) it.act(Inject{"keeper.in", picture});
    CHECK_FALSE(it.live->history().is_cut());
    it.act(Inject{"keeper.in", picture});
    CHECK(it.live->history().is_cut());
    CHECK(it.seek(0) ==
          "the past is not kept any more: the messages and acts of this run need more than 256 MB; a journal "
          "(--journal) has them");
    it.act(Inject{"keeper.in", picture});
    CHECK(kept(*it.live) == 6);
    for (std::size_t index = 0; index < 6; ++index) {
        const auto& event = it.live->history().event(0, index);
        const Act& act = std::get<std::shared_ptr<const PastAct>>(event.what)->act;
        CHECK(is_equal(std::get<Inject>(act).value, Value()));  // the time line shows only what kind of act it was
    }
}

TEST_CASE("small messages from outside that never end need no more memory than large ones", "[lua][past]") {
    RunHistory history;
    const auto act = std::make_shared<const PastAct>(PastAct{Inject{"keeper.in", 1}, user});
    std::size_t count = 0;
    while (!history.is_cut()) {
        history.add({ActTime{1, 0, static_cast<std::int64_t>(count)}, act});
        REQUIRE(++count <= RunHistory::most_bytes / sizeof(PastAct));
    }
    history.add({ActTime{1, 0, static_cast<std::int64_t>(count)}, act});
    CHECK(history.branches().front().size() == RunHistory::most_latest);
    CHECK(history.position() == RunHistory::most_latest);
}

TEST_CASE("a run of real robots, which can't go back, keeps only its latest acts, without messages", "[lua][past]") {
    LiveRig it(R"(behavior "keeper" { script = "busy" })", {{"busy", past_behavior}}, disk(), {.real_time = true});
    for (std::size_t count = 0; count < RunHistory::most_latest + 100; ++count) {
        REQUIRE(it.live->act(Inject{"keeper.in", std::vector<short>{1, 2, 3}}, user));
        if (count % 100 == 0) it.tick();
    }
    CHECK(kept(*it.live) == RunHistory::most_latest);
    const auto& event = it.live->history().event(0, 0);
    CHECK(is_equal(std::get<Inject>(std::get<std::shared_ptr<const PastAct>>(event.what)->act).value, Value()));
    const auto back = it.live->act(Seek{.tick = 0}, user);
    REQUIRE_FALSE(back);
    CHECK(describe(back.error()) == "real robots can't go back in time");
}
