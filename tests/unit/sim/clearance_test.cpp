// Gaps between shapes seen from above, and the clearance of robots, worked by hand.
#include "tests/unit/sim/try_world.hpp"

#include "sim/shape.hpp"

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("the gap between two shapes is that of their rims", "[sim][clearance]") {
    const Shape square{.kind = Shape::Kind::box, .half = {0.5, 0.5, 0.5}};
    Shape other = square;
    other.centre = {3, 0, 7};
    CHECK(gap_from_above(square, other) == Approx(2));
    other.centre = {3, 5, 0};
    CHECK(gap_from_above(square, other) == Approx(std::hypot(2, 4)));
    other.centre = {2, 0, 0};
    other.rotation = yaw_rotation(M_PI / 4);
    CHECK(gap_from_above(square, other) == Approx(1.5 - std::sqrt(0.5)));
    CHECK(gap_from_above(other, square) == Approx(1.5 - std::sqrt(0.5)));
    other.centre = {0.2, 0, 0};
    CHECK(gap_from_above(square, other) == 0);
    Shape disc{.kind = Shape::Kind::cylinder, .centre = {3, 4, 0}, .half = {1, 1, 2}};
    CHECK(gap_from_above(square, disc) == Approx(std::hypot(2.5, 3.5) - 1));
    const Shape small{.kind = Shape::Kind::cylinder, .half = {0.5, 0.5, 1}};
    CHECK(gap_from_above(small, disc) == Approx(3.5));
    disc.centre = {0.5, 0, 0};
    CHECK(gap_from_above(disc, small) == 0);
}

TEST_CASE("the clearance of a robot is the gap to the nearest object", "[sim][clearance]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.5, 0, 0.1}, .size = {0.1, 0.1, 0.2}});
    arena.boxes.push_back({.at = {0.1, 0, 0.5}, .size = {0.1, 0.1, 0.2}});  // above it
    arena.cylinders.push_back({.at = {0, -0.48, 0.1}, .radius = 0.05, .height = 0.2, .mass = 0.1});
    TryWorld w(arena);
    const RobotId mouse = w.add(mouse_spec(), 0, 0);
    // 0.10 m by 0.08 m.
    CHECK(w.world->clearance(mouse, World::most_clearance).value() == Approx(0.39).margin(1e-3));
    // A greater one is not needed, and takes no time.
    CHECK(w.world->clearance(mouse, 0.1) == 0.1);
    CHECK(w.world->clearance(mouse, 0.4).value() == Approx(0.39).margin(1e-3));
    const RobotId behind = w.add(mouse_spec(), -0.3, 0);
    CHECK(w.world->clearance(mouse, World::most_clearance).value() == Approx(0.2).margin(1e-3));
    CHECK(w.world->clearance(behind, World::most_clearance).value() == Approx(0.2).margin(1e-3));
}

TEST_CASE("a robot that touches something has no clearance, one far from everything the most", "[sim][clearance]") {
    TryWorld alone;
    CHECK(alone.world->clearance(alone.add(mouse_spec(), 0, 0), World::most_clearance).value() ==
          World::most_clearance);
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.2, 0, 0.1}, .size = {0.1, 1, 0.2}});
    TryWorld w(arena);
    const RobotId mouse = w.add(mouse_spec(), 0, 0);
    w.bodies.back()->set_wheel_speeds({0.3, 0.3});
    double least = 1;
    for (int i = 0; i < 400 && !w.world->collided(mouse); ++i) {
        const double clearance = w.world->clearance(mouse, World::most_clearance).value();
        CHECK(clearance <= least + 1e-6);
        least = clearance;
        w.world->step(1);
    }
    CHECK(w.world->collided(mouse));
    CHECK(least < 0.01);
    CHECK(w.world->clearance(mouse, World::most_clearance).value() == 0);
}
