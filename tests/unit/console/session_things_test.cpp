// The console moves the things of the arena.
#include <catch2/catch.hpp>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

TEST_CASE("the console moves a box, and omitted coordinates do not change", "[console]") {
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

TEST_CASE("save writes moved objects and markers, and restart moves them back", "[console]") {
    SessionRig it;
    it.type("marker { name = 'target', id = 7, at = { 1, 0, 0.1 } }");
    it.type("teleport('box 1', { x = 1.5, y = 0.25, heading = 0.5 }) teleport('target', { x = 2, heading = 3 })");
    const std::string file = it.live->spec().file;
    CHECK_THAT(it.type("save \"" + file + "\""), Catch::Matchers::StartsWith("saved "));
    it.type("teleport('box 1', { x = 0.5, y = -1 }) teleport('target', { x = 0 }) restart()");
    const Pose3D box = it.live->system().world()->things().front().pose;
    CHECK(box.position.x == 1.5);
    CHECK(box.position.y == 0.25);
    CHECK(box.position.z == 0.15);
    CHECK(box.orientation.y == Approx(0.5));
    const Pose3D target = it.live->system().world()->markers().front().pose;
    CHECK(target.position.x == 2);
    CHECK(target.position.z == 0.1);
    CHECK(target.orientation.y == Approx(3));
}
