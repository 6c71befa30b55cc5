// Hosts in lockstep: their ticks go together whatever their clocks and the network do, and what they are told when time
// stands.
#include <catch2/catch.hpp>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/trace/trace_hash.hpp"
#include "tests/unit/dds/host_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

using NumbersPart = std::vector<std::int32_t>;

// A host in lockstep that publishes in each tick a number made of all that it has heard.
struct StepRig : HostRig {
    StepRig(Room& its_room, std::string name, std::vector<std::string> hosts = {}, double rate = 100)
        : HostRig(its_room, std::move(name), HostOptions{.lockstep = true, .hosts = std::move(hosts), .rate = rate}) {
        system.observe(hash);
    }
    bool ready() {
        look();
        return system.network()->may_tick();
    }
    /// A tick, if it may come.
    bool try_tick() {
        if (!ready()) return false;
        std::int64_t sum = system.now().tick;
        for (const std::int32_t number : part->numbers) sum = (31 * sum + number) % 10'007;
        part->count.write(static_cast<std::int32_t>(sum));
        tick();
        return true;
    }
    std::int64_t ticks() const { return system.now().tick; }
    TraceHash hash;
};

// All try to tick, a tenth of a second apart.
template <class... Rig>
void pass_together(Room& room, int times, Rig&... rigs) {
    for (int i = 0; i < times; ++i) {
        room.clock += 0.1;
        (rigs.try_tick(), ...);
    }
}

}  // namespace

TEST_CASE("a message published in a host's tick is received in the next tick of the other", "[dds][lockstep]") {
    Room room;
    StepRig one(room, "one", {"two"}), two(room, "two");
    REQUIRE(two.system.connect("one/part.count", "part.number"));
    CHECK_FALSE(one.ready());
    room.clock += 0.1;
    while (!one.try_tick()) {
        room.clock += 0.1;
        two.look();
    }
    CHECK_FALSE(one.ready());  // not before the other's first tick is done
    REQUIRE(two.try_tick());
    CHECK(two.part->numbers.empty());
    CHECK(two.arrivals.empty());
    const std::int32_t first = one.part->count.messages()[0].data;
    REQUIRE(one.try_tick());
    CHECK_FALSE(one.ready());  // nor two ticks ahead
    REQUIRE(two.try_tick());
    CHECK(two.part->numbers == NumbersPart{first});
    CHECK(two.arrivals == std::vector<std::string>{"Write by network one"});
    CHECK(two.ticks() == 2);
}

TEST_CASE("hosts in lockstep give the same run with any speed and any loss of messages", "[dds][lockstep]") {
    std::vector<std::uint64_t> before;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        Room room;
        StepRig a(room, "a", {"b", "c"}), b(room, "b"), c(room, "c", {"b"});
        REQUIRE(b.system.connect("a/part.count", "part.number"));
        REQUIRE(b.system.connect("part.count", "c/part.number"));
        REQUIRE(c.system.connect("part.count", "a/part.number"));
        std::mt19937 random(seed);
        const std::vector<StepRig*> all{&a, &b, &c};
        constexpr std::int64_t ticks = 200;
        for (int tries = 0; a.ticks() < ticks || b.ticks() < ticks || c.ticks() < ticks; ++tries) {
            REQUIRE(tries < 100'000);
            room.clock += 0.001 * static_cast<double>(random() % 200);
            const bool begun = a.ticks() > 0 && b.ticks() > 0 && c.ticks() > 0;
            room.domain.cut = begun && random() % 4 == 0;
            StepRig& next = *all[random() % 3];
            if (next.ticks() < ticks) next.try_tick();
            next.look();
        }
        const std::vector<std::uint64_t> now{a.hash.value(), b.hash.value(), c.hash.value()};
        CHECK(a.part->numbers.size() == ticks - 1);
        if (before.empty()) before = now;
        CHECK(now == before);
    }
}

TEST_CASE("a run waits for a named host, and reports it when it takes long", "[dds][lockstep]") {
    Room room;
    StepRig one(room, "one");
    REQUIRE(one.system.connect("two/part.count", "part.number"));
    pass_together(room, 8, one);
    CHECK_FALSE(one.told("time is stopped"));
    pass_together(room, 30, one);
    CHECK(one.ticks() == 0);
    CHECK(one.log == std::vector<std::string>{"warn: lockstep: time is stopped at 0.00 s: waits for host two"});
    StepRig two(room, "two");
    pass_together(room, 10, one, two);
    CHECK(one.ticks() > 3);
    CHECK(one.told("info: lockstep: in step with host two"));
    CHECK(one.told("info: lockstep: time continues"));
}

TEST_CASE("a host that names no other waits for the first host that names it", "[dds][lockstep]") {
    Room room;
    StepRig one(room, "one");
    pass_together(room, 30, one);
    CHECK(one.ticks() == 0);
    CHECK(one.told("time is stopped at 0.00 s: waits for another host in lockstep"));
    StepRig two(room, "two", {"one"});
    pass_together(room, 10, one, two);
    CHECK(one.ticks() > 3);
}

TEST_CASE("time stands for all hosts while one is silent, paused or waiting", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), b(room, "b", {"a"}), c(room, "c", {"b"});
    pass_together(room, 20, a, b, c);
    const std::int64_t ticks = a.ticks();
    REQUIRE(ticks > 5);
    SECTION("silent") {
        pass_together(room, 30, a, b);
        CHECK(b.told("host c is silent"));
        CHECK(a.told("time is stopped at 0."));
        CHECK(a.told("host b waits for host c"));
        CHECK(a.ticks() <= ticks + 5);
    }
    SECTION("paused") {
        for (int i = 0; i < 30; ++i) {
            c.look();
            pass_together(room, 1, a, b);
        }
        CHECK(b.told("host c is paused"));
        CHECK(a.ticks() <= ticks + 5);
    }
    pass_together(room, 20, a, b, c);
    CHECK(a.ticks() > ticks + 10);
    CHECK(a.told("lockstep: time continues"));
}

TEST_CASE("the other hosts continue without a host that ends, and with one that is restarted", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a");
    auto b = std::make_unique<StepRig>(room, "b", std::vector<std::string>{"a"});
    REQUIRE(b->system.connect("a/part.count", "part.number"));
    pass_together(room, 20, a, *b);
    const std::int64_t ticks = a.ticks();
    SECTION("in good order") {
        b->system.network()->leave();
        pass_together(room, 10, a);
        CHECK(a.told("info: lockstep: host b has ended: this one continues without it"));
        CHECK(a.ticks() > ticks + 5);
        REQUIRE(b->try_tick());  // while its robots brake
        b.reset();
        pass_together(room, 10, a);
    }
    SECTION("killed") {
        room.domain.cut = true;
        b.reset();
        room.domain.cut = false;
        pass_together(room, 20, a);
        CHECK(a.ticks() <= ticks + 3);
        CHECK(a.told("waits for host b") != a.told("host b is silent"));
    }
    b = std::make_unique<StepRig>(room, "b", std::vector<std::string>{"a"});
    REQUIRE(b->system.connect("a/part.count", "part.number"));
    const std::int64_t again = a.ticks();
    pass_together(room, 20, a, *b);
    CHECK(b->ticks() > 10);
    CHECK(a.ticks() - again - b->ticks() <= 2);
    CHECK(a.told("s on; for reproducible runs start them together"));
    CHECK(b->part->numbers.size() + 2 >= static_cast<std::size_t>(b->ticks()));
}

TEST_CASE("hosts do not wait for a killed run when a newer run of that host has ended", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), killed(room, "b", {"a"});
    pass_together(room, 10, a, killed);
    {
        StepRig b(room, "b", {"a"});
        pass_together(room, 10, a, b);
        REQUIRE(b.ticks() > 5);
        b.system.network()->leave();
    }
    const std::int64_t ticks = a.ticks();
    pass_together(room, 20, a);
    CHECK(a.ticks() > ticks + 10);
}

TEST_CASE("hosts do not wait for a host that left before it was heard", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), b(room, "b", {"a"});
    pass_together(room, 10, a, b);
    {
        StepRig early(room, "early", {"a"});
        pass_together(room, 1, early, a);
        room.domain.cut = true;
        pass_together(room, 1, a, early);
    }
    room.domain.cut = false;
    const std::int64_t ticks = a.ticks();
    pass_together(room, 20, a, b);
    CHECK(a.ticks() > ticks + 10);
}

TEST_CASE("all messages of a host are received after it has left", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), b(room, "b");
    REQUIRE(a.system.connect("b/part.count", "part.number"));
    pass_together(room, 20, a, b);
    while (b.ticks() <= a.ticks()) pass_together(room, 1, b);
    room.domain.cut = true;
    a.try_tick();
    room.domain.cut = false;
    b.look();
    b.system.network()->leave();
    pass_together(room, 10, a);
    CHECK(a.ticks() > b.ticks());
    CHECK(a.part->numbers.size() == static_cast<std::size_t>(b.ticks()));
}

TEST_CASE("a late host joins, and a message says how to start together", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), b(room, "b", {"a"});
    pass_together(room, 20, a, b);
    StepRig late(room, "late", {"a"});
    const std::int64_t ticks = a.ticks();
    pass_together(room, 20, a, b, late);
    CHECK(a.told("start them together: network { hosts = \"late\" } waits for it"));
    CHECK(late.ticks() > 10);
    CHECK(a.ticks() - ticks - late.ticks() <= 3);
}

TEST_CASE("different tick rates are refused at both hosts", "[dds][lockstep]") {
    Room room;
    StepRig one(room, "one", {"two"}), two(room, "two", {"one"}, 50);
    pass_together(room, 30, one, two);
    CHECK(one.told(
        "error: lockstep: host two has 50 ticks per second, this one 100: say rate(50) here or rate(100) there, "
        "and restart()"));
    CHECK(two.told(
        "error: lockstep: host one has 100 ticks per second, this one 50: say rate(100) here or rate(50) there"));
    CHECK(one.ticks() == 0);
    CHECK(one.told("time is stopped at 0.00 s: host two has another tick rate"));
}

TEST_CASE("a host that is not in lockstep is reported, and hosts do not wait for it", "[dds][lockstep]") {
    Room room;
    StepRig one(room, "one");
    HostRig two(room, "two");
    REQUIRE(one.system.connect("two/part.count", "part.number"));
    for (int i = 0; i < 20; ++i) {
        two.part->count.write(i);
        pass(room, 1, two);
        pass_together(room, 1, one);
    }
    CHECK(
        one.told("warn: host two is not in lockstep: its messages arrive at any time; set "
                 "network { lockstep = true } there"));
    CHECK(one.ticks() > 10);
    CHECK(one.part->numbers.size() > 10);
}

TEST_CASE("hosts whose last connection ends leave lockstep", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), b(room, "b");
    REQUIRE(b.system.connect("a/part.count", "part.number"));
    pass_together(room, 20, a, b);
    REQUIRE(b.system.disconnect("a/part.count", "part.number"));
    pass_together(room, 20, a, b);
    const std::int64_t ticks = a.ticks();
    pass_together(room, 20, a);
    CHECK(a.ticks() == ticks + 20);
    // And again, when there is one again.
    REQUIRE(b.system.connect("a/part.count", "part.number"));
    const std::size_t heard = b.part->numbers.size();
    pass_together(room, 20, a, b);
    CHECK(b.part->numbers.size() > heard + 10);
    const std::int64_t stands = a.ticks();
    pass_together(room, 20, a);
    CHECK(a.ticks() <= stands + 3);
}

TEST_CASE("an emergency stop and a change of parameters delay no host", "[dds][lockstep]") {
    Room room;
    StepRig a(room, "a"), b(room, "b", {"a"});
    pass_together(room, 10, a, b);
    const std::int64_t ticks = b.ticks();
    REQUIRE(a.act(Stop{}, {}));
    pass_together(room, 10, a, b);
    CHECK(b.ticks() > ticks + 5);
    REQUIRE(a.act(Rearm{}, {}));
}
