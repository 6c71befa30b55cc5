// Boxes, walls and cylinders that are moved, and poses of robots.
#include <algorithm>
#include <cmath>

#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

ArenaSpec furnished() {
    ArenaSpec arena;
    arena.size = Point2D{4, 4};
    arena.boxes.push_back({.at = {1, 0, 0.15}, .size = {0.1, 1, 0.3}});
    arena.boxes.push_back({.at = {-1, 0, 0.05}, .size = {0.1, 0.1, 0.1}, .mass = 0.2});
    arena.cylinders.push_back({.at = {0, 1.5, 0.1}, .radius = 0.05, .height = 0.2});
    return arena;
}

const ThingPose& thing(const std::vector<ThingPose>& things, const std::string& name) {
    const auto found = std::find_if(things.begin(), things.end(), [&](const auto& each) { return each.name == name; });
    REQUIRE(found != things.end());
    return *found;
}

double nearest(TryWorld& w) {
    std::vector<double> ranges(w.specs.front()->sensors.size());
    w.bodies.front()->read_ranges(ranges);
    return *std::min_element(ranges.begin(), ranges.end());
}

std::string refusal(TryWorld& w, const std::string& name, Pose2D pose) {
    const auto moved = w.world->move_thing(name, pose);
    return moved ? "" : moved.error().message;
}

}  // namespace

TEST_CASE("a moved wall is seen and touched at its new place only", "[sim][moving]") {
    for (const int others : {0, 12}) {  // few are tested one by one, many are found in a grid
        ArenaSpec arena = furnished();
        for (int i = 0; i < others; ++i) arena.boxes.push_back({.at = {-1.5, 0.1 * i, 0.1}, .size = {0.05, 0.05, 0.2}});
        TryWorld w(arena);
        w.add(mouse_spec(), 0.5, 0);
        CHECK(nearest(w) == Approx(0.45 - 0.035).margin(1e-6));
        REQUIRE(w.world->move_thing("box 1", {{0.8, 0}, 0}));
        CHECK(nearest(w) == Approx(0.25 - 0.035).margin(1e-6));
        const ThingPose moved = thing(w.world->things(), "box 1");
        CHECK(moved.pose.position == Point3D{0.8, 0, 0.15});
        REQUIRE(w.world->move_thing("box 1", {{0.8, 1.4}, M_PI / 2}));
        CHECK(nearest(w) == INFINITY);
        CHECK(thing(w.world->things(), "box 1").pose.orientation.y == Approx(M_PI / 2));

        REQUIRE(w.world->move_thing("box 1", {{0.7, 0}, 0}));
        w.bodies.front()->set_wheel_speeds({0.2, 0.2});
        w.run(1.5);
        CHECK(w.world->collided_with(0) == "box 1");
        CHECK(w.truth().pose.position.x < 0.61);
    }
}

TEST_CASE("a moved thing is at rest, and things that stood on it fall", "[sim][moving]") {
    ArenaSpec arena = furnished();
    arena.boxes.push_back({.at = {-1, 0, 0.125}, .size = {0.05, 0.05, 0.05}, .mass = 0.1});
    TryWorld w(arena);
    w.run(2);  // all asleep
    REQUIRE(w.world->move_thing("box 2", {{0, 0}, 1}));
    w.run(2);
    const auto things = w.world->things();
    CHECK(thing(things, "box 2").pose.position.x == Approx(0).margin(1e-3));
    CHECK(thing(things, "box 2").pose.orientation.y == Approx(1).margin(1e-2));
    CHECK(thing(things, "box 3").pose.position.z == Approx(0.025).margin(2e-3));
}

TEST_CASE("a move to an impossible place is refused and changes nothing", "[sim][moving]") {
    TryWorld w(furnished());
    w.add(mouse_spec(), 0, 0, 0, "mouse");
    const auto before = w.world->things();
    CHECK(refusal(w, "box 1", {{2.5, 0}, 0}) ==
          "box 1 at x = 2.5, y = 0 is outside the arena of 4 x 4 m: put it inside, or set border = false");
    CHECK(refusal(w, "box 1", {{0, 0}, 0}) == "box 1 at x = 0, y = 0 overlaps robot 'mouse': move one of them");
    CHECK(refusal(w, "box 1", {{-1, 0}, 0}) == "box 1 at x = -1, y = 0 overlaps box 2: move one of them");
    CHECK(refusal(w, "box 2", {{1, 0}, 0}) == "box 2 at x = 1, y = 0 overlaps box 1: move one of them");
    CHECK(refusal(w, "box 2", {{1.99, 1.5}, 0}) ==
          "box 2 at x = 1.99, y = 1.5 overlaps the arena's wall: move one of them");
    CHECK(refusal(w, "box 1", {{NAN, 0}, 0}) == "box 1: its pose: expected a finite number, got nan");
    CHECK(refusal(w, "box 1", {{1e300, 0}, 0}) == "box 1: its pose: expected a number up to 1000000, got 1e+300");
    CHECK(refusal(w, "box 1", {{-1e300, 0}, 0}) == "box 1: its pose: expected a number from -1000000 on, got -1e+300");
    CHECK(refusal(w, "wall", {{0, 0}, 0}) == "the walls of the arena's border can't be moved");
    CHECK(refusal(w, "box 7", {{0, 0}, 0}).find("there is no thing 'box 7' (did you mean 'box ") == 0);
    const auto after = w.world->things();
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].pose == before[i].pose);
}

TEST_CASE("walls may overlap each other, as in a maze", "[sim][moving]") {
    TryWorld w(furnished());
    CHECK(w.world->move_thing("cylinder 1", {{1, 0}, 0}));
    CHECK(w.world->move_thing("box 1", {{2, 0}, 0}));
}

TEST_CASE("the same interventions at the same steps give the same bits", "[sim][moving]") {
    std::vector<double> first;
    for (int time = 0; time < 2; ++time) {
        TryWorld w(furnished());
        w.add(mouse_spec(), 0, 0);
        w.bodies.front()->set_wheel_speeds({0.2, 0.18});
        w.run(1);
        REQUIRE(w.world->move_thing("box 2", {{0.45, 0}, 0.3}));
        w.run(2);
        if (time == 0) first = w.bits();
        CHECK(w.bits() == first);
    }
}

TEST_CASE("the pose of a robot on a ramp is pitched up", "[sim][moving]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.4, 0, -0.02}, .size = {0.8, 1, 0.1}, .pitch = -0.1});
    TryWorld w(arena);
    w.add(mouse_spec(), -0.1, 0);
    w.bodies.front()->set_wheel_speeds({0.2, 0.2});
    w.run(2);
    const Pose3D pose = w.world->pose(0);
    CHECK(pose.orientation.p == Approx(-0.1).margin(0.02));
    CHECK(pose.orientation.r == Approx(0).margin(0.02));
    CHECK(pose.orientation.y == Approx(w.truth().pose.heading));
    CHECK(pose.position.z == w.truth().height);
    CHECK(w.truth().tilt == Approx(0.1).margin(0.02));
}

TEST_CASE("a ray has the index of its distance", "[sim][moving]") {
    TryWorld w(furnished());
    w.add(mouse_spec(), 0.5, 0);
    const auto rays = w.world->rays(0);
    REQUIRE(rays.size() == 4);
    for (std::size_t i = 0; i < rays.size(); ++i) CHECK(rays[i].distance == i);
}
