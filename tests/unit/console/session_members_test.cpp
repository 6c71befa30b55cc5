// What is added to the running system at the prompt, and taken away.
#include <catch2/catch.hpp>

#include <string>

#include "engine/trace/trace.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a marker is added, moved and removed", "[console][session][act]") {
    SessionRig it;
    const auto count = [&] { return it.live->system().world()->markers().size(); };
    CHECK(it.type("marker { name = 'target', id = 7, size = 0.1, at = { 1, 0, 0.1 }, facing = math.pi }").empty());
    CHECK(count() == 1);
    CHECK(it.live->spec().arena.markers.size() == 1);
    CHECK(it.type("teleport('target', { x = 1.5, heading = 0.5 })").empty());
    CHECK(it.live->system().world()->markers()[0].pose.position == Point3D{1.5, 0, 0.1});
    CHECK(it.live->system().world()->markers()[0].pose.orientation.y == 0.5);
    CHECK_THAT(it.type("marker { name = 'target', id = 8, at = { 1, 0, 0.1 } }"),
               Contains("another marker has the name 'target'"));
    CHECK_THAT(it.type("marker { name = 'no', id = 587, at = { 1, 0, 0.1 } }"), Contains("586"));
    CHECK(it.type("marker {}") ==
          "! marker: field 'id' is missing: expected a whole number from 0 to 586: the tag's number");
    CHECK(it.type("marker(7)") ==
          "! marker: expected a table, as in marker { name = \"target\", id = 7, size = 0.1, at = { 1, 0, 0.1 } }");
    CHECK(count() == 1);
    CHECK(it.type("remove 'target'").empty());
    CHECK(count() == 0);
    CHECK(it.live->spec().arena.markers.empty());
    CHECK_THAT(it.type("remove 'target'"), StartsWith("! remove: there is no component 'target'"));
}

TEST_CASE("a hold ends when its port is removed, and a new port of this name is free", "[console][session][act]") {
    SessionRig it;
    it.type("hold(controller.out, { vx = 0.1 })");
    it.type("watch(controller.out) remove 'controller'");
    CHECK(it.live->system().held_by({Actor::Kind::console}).empty());
    it.turn(3);
    CHECK(it.type("behavior 'controller' { script = 'counter' } return controller.out.override").find("\"\"") !=
          std::string::npos);
    CHECK(it.type("step(3) return controller.out.value.vx") == "0.25");
}

TEST_CASE("restart reports what would be lost, unless the file contains it", "[console][session][act]") {
    SessionRig it;
    it.type("behavior 'second' { script = 'counter' } marker { name = 'target', id = 7, at = { 1, 0, 0.1 } }");
    const std::string file = it.live->spec().file;
    CHECK(it.type("restart()") == "! restart: second, target would be lost: save \"" + file +
                                      "\" keeps them in the system's file, restart \"anyway\" drops them");
    CHECK(it.type("second.status") == "\"ACTIVE\"");
    CHECK(it.type("restart 'now'") == "! restart: expected nothing, or \"anyway\", got 'now'");
    SECTION("they are saved to it") {
        CHECK_THAT(it.type("save \"" + file + "\""), StartsWith("saved "));
        CHECK(it.type("restart()") == "restarted, time is 0");
        CHECK(it.type("second.status") == "\"ACTIVE\"");
        CHECK(it.live->system().world()->markers().size() == 1);
    }
    SECTION("it is meant") {
        CHECK(it.type("restart 'anyway'") == "restarted, time is 0");
        CHECK_THAT(it.type("second"), StartsWith("! unknown name 'second'"));
        CHECK(it.type("restart()") == "restarted, time is 0");
    }
}
