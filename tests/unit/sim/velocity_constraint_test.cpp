// A velocity constraint on a robot: the forced velocities and the effect on the wheels.
#include <cmath>

#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("a velocity constraint forces its velocities on a robot whose motors hold", "[sim][robot][disturb]") {
    TryWorld w;
    w.add(mouse_spec(), 0, 0);
    w.run(0.1);
    w.world->disturb(0, {.vx = 0.2});
    w.run(2);
    CHECK(w.truth().velocity.vx == Approx(0.2).epsilon(0.02));
    CHECK(w.truth().pose.position.x == Approx(0.4).epsilon(0.03));
    CHECK(w.bodies[0]->wheel_angles() == Wheels{});  // stepping motors that hold: the wheels slip
    CHECK(w.truth().tilt < 0.01);                    // and the robot is held level
    w.world->disturb(0, {.vx = -0.1, .vy = 0.05, .va = 1.0});
    w.run(1);
    CHECK(w.truth().velocity.vx == Approx(-0.1).margin(0.005));
    CHECK(w.truth().velocity.vy == Approx(0.05).margin(0.005));
    CHECK(w.truth().velocity.va == Approx(1.0).epsilon(0.02));
    w.world->disturb(0, {});
    w.run(0.5);
    CHECK(std::abs(w.truth().velocity.vx) < 1e-3);
    CHECK(std::abs(w.truth().velocity.va) < 1e-3);
}

TEST_CASE("a velocity constraint does not push a robot through a wall", "[sim][robot][disturb]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.3, 0, 0.1}, .size = {0.02, 1, 0.2}});
    TryWorld w(arena);
    w.add(mouse_spec(), 0, 0);
    w.world->disturb(0, {.vx = 0.5});
    w.run(3);
    CHECK(w.truth().pose.position.x + 0.05 < 0.295);
    CHECK(w.world->collided_with(0) == "box 1");
}

TEST_CASE("coasting wheels turn with the ground when the robot is pushed", "[sim][robot][disturb]") {
    TryWorld w;
    w.add(mouse_spec(), 0, 0);
    w.bodies[0]->coast();
    w.world->disturb(0, {.vx = 0.2, .va = 0.0});
    w.run(2);
    CHECK(w.bodies[0]->wheel_angles().left * 0.024 == Approx(w.truth().pose.position.x).epsilon(0.01));
    CHECK(w.bodies[0]->wheel_angles().right * 0.024 == Approx(w.truth().pose.position.x).epsilon(0.01));
    CHECK(w.truth().tilt < 0.01);  // nothing brakes it
    const Wheels before = w.bodies[0]->wheel_angles();
    w.world->disturb(0, {.vx = 0.0, .va = 1.0});
    w.run(1);
    CHECK((w.bodies[0]->wheel_angles().right - before.right) * 0.024 == Approx(0.0925 / 2).epsilon(0.03));
    CHECK((w.bodies[0]->wheel_angles().left - before.left) * 0.024 == Approx(-0.0925 / 2).epsilon(0.03));
    // After the release it rolls on for a while; a command controls the wheels again.
    w.world->disturb(0, {.vx = 0.3});
    w.run(1);
    w.world->disturb(0, {});
    w.run(0.5);
    CHECK(w.truth().velocity.vx > 0.2);
    w.bodies[0]->set_wheel_speeds({0, 0});
    w.run(0.5);
    CHECK(std::abs(w.truth().velocity.vx) < 1e-3);
}

TEST_CASE("the velocities of a constraint are those of the robot's origin, not of its hull", "[sim][robot][disturb]") {
    for (const bool ahead : {true, false}) {
        RobotSpec spec = mouse_spec();
        spec.body.at.x = 0.03;
        TryWorld w;
        w.add(spec, 0, 0);
        w.run(0.1);
        w.world->disturb(0, {.vx = ahead ? std::optional(0.1) : std::nullopt, .vy = 0.05, .va = 1.0});
        w.run(0.5);
        INFO((ahead ? "pushed ahead as well" : "pushed to the side"));
        CHECK(w.truth().velocity.vy == Approx(0.05).margin(0.005));
        CHECK(w.truth().velocity.va == Approx(1.0).epsilon(0.02));
    }
}
