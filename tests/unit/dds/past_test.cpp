// A system that other hosts are connected with goes back alone, and comes back to them.
#include <catch2/catch.hpp>

#include "bindings/dds/network_maker.hpp"
#include "bindings/journal/journal.hpp"
#include "bindings/journal/replay.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "engine/live/running_system.hpp"
#include "tests/unit/dds/host_rig.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/peer_words.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

const Actor past_person{Actor::Kind::console, ""};

// A live system "here", which drives the part of another host and counts its numbers.
struct HostWithPast {
    explicit HostWithPast(bool lockstep = false) {
        folder.write("behaviors/driver.lua", R"(
local number = input("number", "TimedLong", "what the other host counts")
local target = output("target", "TimedVelocity2D", "for the other host")
param("speed", 0.25)
state.sum = 0
function on_execute()
  state.sum = state.sum + (number:read() or 0)
  target:write { vx = config.speed, va = state.sum * 1e-3 }
end
)");
        const auto file = folder.write("system.lua", std::string("network { name = \"here\", open = true") +
                                                         (lockstep ? ", lockstep = true" : "") + R"( }
behavior "driver" { script = "driver" }
connect("other/part.count", "driver.number")
connect("driver.target", "other/part.target")
)");
        LiveOptions options = alone();
        options.network = [this, lockstep](const SystemSpec&, System& system) -> Expected<std::unique_ptr<Network>> {
            HostSettings settings;
            settings.name = "here";
            settings.run = ++room.runs;
            settings.clock = [this] { return room.clock; };
            settings.lockstep = lockstep;
            return std::make_unique<SystemNetwork>(system, *transport, std::move(settings));
        };
        auto loaded = RunningSystem::load(file, std::move(options));
        if (!loaded) FAIL(describe(loaded.error()));
        live = std::move(*loaded);
        journal = std::move(Journal::create(folder.path("run.journal")).value());
        journal->begin(*live, "test", false);
        live->activate();
    }
    static LiveOptions alone() {
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.peer_words = peer_words();
        options.network = options.network_of_past = make_silent_networks();
        return options;
    }
    // Both hosts tick; the other one counts.
    void pass_both(int times) {
        for (int i = 0; i < times; ++i) {
            room.clock += 0.1;
            other.part->count.write(++counted);
            other.tick();
            live->tick();
        }
    }
    std::string act(const Act& act) {
        const auto done = live->act(act, past_person);
        return done ? "" : describe(done.error());
    }

    Room room;
    std::unique_ptr<DdsTransport> transport = room.domain.join();
    HostRig other{room, "other"};
    Scratch folder;
    std::unique_ptr<RunningSystem> live;
    std::unique_ptr<Journal> journal;
    std::int32_t counted = 0;
};

}  // namespace

TEST_CASE("a system goes back alone: other hosts get zero velocities, then nothing, and find it again",
          "[dds][network][past]") {
    HostWithPast it;
    it.pass_both(30);
    REQUIRE(!it.other.part->targets.empty());
    CHECK(it.other.part->targets.back().data.vx == 0.25);
    const std::uint64_t then = it.live->trace_hash();
    it.pass_both(20);
    it.other.part->targets.clear();

    REQUIRE(it.act(Seek{.tick = 30}) == "");
    CHECK(it.live->is_away());
    CHECK(it.live->trace_hash() == then);  // with what came from the other host
    it.other.tick();
    REQUIRE(it.other.part->targets.size() == 1);
    CHECK(it.other.part->targets[0].data == Velocity2D{});

    // In the past nothing is sent, and what comes begins no branch.
    it.other.part->targets.clear();
    it.pass_both(10);
    CHECK(it.live->system().now().tick == 40);
    CHECK(it.other.part->targets.empty());
    CHECK(it.live->history().branches().size() == 1);
    CHECK_FALSE(it.live->differs());

    // The seek itself has let one tick pass: the one with the zero velocity.
    REQUIRE(it.act(it.live->back()) == "");
    CHECK_FALSE(it.live->is_away());
    CHECK(it.live->system().now().tick == 51);
    it.pass_both(10);
    REQUIRE(!it.other.part->targets.empty());
    CHECK(it.other.part->targets.back().data.vx == 0.25);
    CHECK(it.live->history().branches().size() == 1);
}

TEST_CASE("at the end of the known future, other hosts are there again", "[dds][network][past]") {
    HostWithPast it;
    it.pass_both(40);
    REQUIRE(it.act(Seek{.tick = 35}) == "");
    it.pass_both(6);
    CHECK(it.live->is_away());
    it.other.part->targets.clear();
    it.pass_both(2);
    CHECK_FALSE(it.live->is_away());
    CHECK(it.live->system().now().tick == 43);
    CHECK(!it.other.part->targets.empty());
    // Its past has the messages of then, whenever they came.
    const std::uint64_t now = it.live->trace_hash();
    it.pass_both(5);
    REQUIRE(it.act(Seek{.tick = 43}) == "");
    CHECK(it.live->trace_hash() == now);
}

TEST_CASE("a branch of a system with hosts runs without them until somebody comes back", "[dds][network][past]") {
    HostWithPast it;
    it.pass_both(40);
    REQUIRE(it.act(Seek{.tick = 20}) == "");
    it.other.tick();
    it.other.part->targets.clear();
    REQUIRE(it.act(SetParameter{"driver", "speed", 0.5}) == "");
    CHECK(it.live->history().branches().size() == 2);
    it.pass_both(30);
    CHECK(it.live->is_away());
    CHECK(it.other.part->targets.empty());
    CHECK(it.live->back().branch == "main");
    REQUIRE(it.act(it.live->back()) == "");
    it.pass_both(2);
    CHECK(it.other.part->targets.back().data.vx == 0.25);
    // The branch is still there to go to.
    REQUIRE(it.act(Seek{.branch = "branch 1"}) == "");
    CHECK(it.live->is_away());
    CHECK(it.live->system().now().tick == 50);
}

TEST_CASE("a restart in the past is the present of other hosts", "[dds][network][past]") {
    HostWithPast it;
    it.pass_both(30);
    REQUIRE(it.act(Seek{.tick = 10}) == "");
    REQUIRE(it.act(Restart{}) == "");
    CHECK_FALSE(it.live->is_away());
    it.other.part->targets.clear();
    it.pass_both(15);
    REQUIRE(!it.other.part->targets.empty());
    CHECK(it.other.part->targets.back().data.vx == 0.25);
}

TEST_CASE("the journal of a system that went back and came back to its hosts repeats that", "[dds][network][past]") {
    HostWithPast it;
    it.pass_both(40);
    REQUIRE(it.act(Seek{.tick = 20}) == "");
    it.pass_both(5);
    REQUIRE(it.act(SetParameter{"driver", "speed", 0.5}) == "");
    it.pass_both(10);
    REQUIRE(it.act(it.live->back()) == "");
    it.pass_both(10);
    REQUIRE(it.act(Seek{.tick = 45}) == "");
    it.pass_both(20);  // beyond what is known
    CHECK_FALSE(it.live->is_away());
    it.journal->end(RunEnd::duration, "", it.live->when(), it.live->trace_hash());
    auto replay = Replay::read(it.folder.path("run.journal"), "test");
    REQUIRE(replay);
    auto again = (*replay)->load(HostWithPast::alone());
    REQUIRE(again);
    (*again)->activate();
    for (;;) {
        const auto more = (*replay)->before_tick(**again);
        INFO((more ? "" : describe(more.error())));
        REQUIRE(more);
        if (!*more) break;
        (*again)->tick();
    }
    CHECK((*again)->trace_hash() == it.live->trace_hash());
    CHECK((*again)->history().branches().size() == 2);
}

TEST_CASE("hosts in lockstep do not go back", "[dds][network][past]") {
    HostWithPast it(true);
    CHECK(it.act(Seek{.tick = 0}) == "hosts in lockstep share their time: none of them can go back alone");
}
