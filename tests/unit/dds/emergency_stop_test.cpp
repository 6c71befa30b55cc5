// An emergency stop reaches the robots of other hosts that a system drives.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/dds/host_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

// Ticks both; returns the speeds that the second one's part was told.
std::vector<double> drive(Room& room, HostRig& from, HostRig& to, double speed, int ticks) {
    to.part->targets.clear();
    for (int i = 0; i < ticks; ++i) {
        from.part->speed.write({.vx = speed});
        pass(room, 1, from, to);
    }
    pass(room, 1, to);
    std::vector<double> told;
    for (const auto& message : to.part->targets) told.push_back(message.data.vx);
    return told;
}

}  // namespace

TEST_CASE("an emergency stop sends zero to robots of other hosts, until rearm", "[dds][network][stop]") {
    Room room;
    HostRig here(room, "here"), there(room, "there");
    REQUIRE(here.system.connect("part.speed", "there/part.target"));
    pass(room, 5, here, there);
    CHECK(drive(room, here, there, 0.5, 2) == std::vector<double>{0.5, 0.5});
    REQUIRE(here.act(Stop{}, {Actor::Kind::console}));
    CHECK(here.told("warn: emergency stop: there/part.target gets speed 0 until rearm()"));
    CHECK(drive(room, here, there, 0.5, 3) == std::vector<double>{0, 0, 0});
    REQUIRE(here.act(Rearm{}, {Actor::Kind::console}));
    CHECK(drive(room, here, there, 0.5, 2) == std::vector<double>{0.5, 0.5});
}

TEST_CASE("an emergency stop sends zero also where nothing is published", "[dds][network][stop]") {
    Room room;
    HostRig here(room, "here"), there(room, "there");
    REQUIRE(here.system.connect("part.speed", "there/part.target"));
    pass(room, 5, here, there);
    REQUIRE(here.act(Stop{}, {Actor::Kind::console}));
    there.part->targets.clear();
    pass(room, 3, here, there);
    REQUIRE_FALSE(there.part->targets.empty());
    CHECK(there.part->targets.back().data == Velocity2D{});
}

TEST_CASE("an emergency stop says which robots of other hosts it does not reach", "[dds][network][stop]") {
    Room room;
    HostRig here(room, "here");
    REQUIRE(here.system.connect("part.speed", "there/part.target"));
    pass(room, 2, here);
    REQUIRE(here.act(Stop{}, {Actor::Kind::console}));
    CHECK(here.told("the emergency stop does not reach there/part.target: waits for host there: stop it there"));
}
