// The console carries what stands in the arena.
#include <catch2/catch.hpp>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

TEST_CASE("the console carries a box elsewhere, and what is left out stays as it is", "[console]") {
    SessionRig it;
    CHECK(it.type("teleport('box 1', { x = 1.5, heading = 0.5 })").empty());
    const Pose3D moved = it.live->system().world()->things().front().pose;
    CHECK(moved.position.x == 1.5);
    CHECK(moved.position.y == 0);
    CHECK(moved.position.z == 0.15);
    CHECK(moved.orientation.y == Approx(0.5));
    CHECK(it.type("teleport('box 1', { y = 1 })").empty());
    CHECK(it.live->system().world()->things().front().pose.position.x == 1.5);
    CHECK(it.live->system().world()->things().front().pose.position.y == 1);
}

TEST_CASE("the console refuses to carry a box where it can't be", "[console]") {
    SessionRig it;
    CHECK(it.type("teleport('box 1', { x = 0 })") ==
          "! teleport: box 1 at x = 0, y = 0 overlaps robot 'mouse': move one of them");
    CHECK(it.type("teleport('box 1', { z = 1 })") == "! teleport: pose: a thing keeps its height: leave out z");
    CHECK(it.type("teleport('box 1')") == "! teleport: pose: expected a table { x =, y =, heading = }, got nothing");
}
