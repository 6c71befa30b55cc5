// One robot on the floor: driving, standing, slipping and turning.
#include "tests/unit/sim/try_world.hpp"

#include <algorithm>

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("a robot does not flip over at 1.5 m/s with the limit lifted", "[sim][robot][fault]") {
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
        for (const double step : {0.001, 0.005, 0.01}) {
            TryWorld w({}, step);
            w.add(spec, 0, 0);
            double tilt = 0;
            const auto look = [&] { tilt = std::max(tilt, w.truth().tilt); };
            // From standstill to full speed at once, to full reverse, and a stop: the hardest commands.
            w.bodies[0]->set_wheel_speeds({1.5, 1.5});
            w.run(1, look);
            CHECK(w.truth().velocity.vx == Approx(1.5).epsilon(0.01));
            w.bodies[0]->set_wheel_speeds({-1.5, -1.5});
            w.run(1, look);
            CHECK(w.truth().velocity.vx == Approx(-1.5).epsilon(0.01));
            w.bodies[0]->set_wheel_speeds({0, 0});
            w.run(1, look);
            CHECK(tilt < 0.2);
            CHECK(w.truth().tilt < 1e-3);
            CHECK(std::abs(w.truth().velocity.vx) < 1e-3);
        }
    }
}

TEST_CASE("a robot reaches 98 % of 1.5 m/s within 0.35 s", "[sim][robot]") {
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
        TryWorld w;
        w.add(spec, 0, 0);
        w.bodies[0]->set_wheel_speeds({1.5, 1.5});
        w.run(0.35);
        CHECK(w.truth().velocity.vx > 0.98 * 1.5);
    }
}

TEST_CASE("a robot stands on its wheels and drives", "[sim][robot][fault]") {
    for (const double step : {0.001, 0.005, 0.01}) {
        TryWorld w({}, step);
        w.add(mouse_spec(), 0, 0);
        w.run(1);
        CHECK(std::abs(w.truth().height) < 1e-5);
        w.bodies[0]->set_wheel_speeds({0.2, 0.2});
        w.run(1);
        CHECK(w.truth().pose.position.x == Approx(0.2).epsilon(0.02));
        CHECK(w.truth().velocity.vx == Approx(0.2).epsilon(0.001));
    }
}

TEST_CASE("velocity is reported in the robot's frame", "[sim][robot][fault]") {
    for (const double heading : {0.0, M_PI / 2, M_PI, -2.0}) {
        TryWorld w;
        w.add(mouse_spec(), 1, -2, heading);
        w.bodies[0]->set_wheel_speeds({0.2, 0.2});
        w.run(1);
        CHECK(w.truth().velocity.vx == Approx(0.2).epsilon(0.001));
        CHECK(std::abs(w.truth().velocity.vy) < 1e-6);
        CHECK(std::abs(w.truth().velocity.va) < 1e-6);
    }
    TryWorld w;
    w.add(mouse_spec(), 0, 0);
    w.bodies[0]->set_wheel_speeds({0.1, 0.3});
    w.run(3);
    CHECK(w.truth().velocity.vx == Approx(0.2).epsilon(0.002));
    CHECK(std::abs(w.truth().velocity.vy) < 1e-3);
    CHECK(w.truth().velocity.va == Approx(0.2 / 0.0925).epsilon(0.002));
}

TEST_CASE("a robot at rest stays at rest and does not creep", "[sim][robot]") {
    for (RobotSpec spec : {mouse_spec(), swarm_spec()}) {
        // Also with the centre of mass before, or far behind the axle.
        for (const double at : {0.0, 0.005, -0.02}) {
            spec.body.at.x = at;
            TryWorld w;
            w.add(spec, 0.3, 0.2, 0.7);
            double fastest = 0;
            w.run(20, [&] {
                const Truth t = w.truth();
                fastest =
                    std::max({fastest, std::abs(t.velocity.vx), std::abs(t.velocity.vy), std::abs(t.velocity.va)});
            });
            CHECK(fastest < 1e-6);
            CHECK(w.truth().pose.position.x == Approx(0.3).margin(1e-6));
            CHECK(w.truth().pose.heading == Approx(0.7).margin(1e-6));
            CHECK(w.truth().tilt < 1e-4);
            CHECK_FALSE(w.world->collided(0));
        }
    }
}

TEST_CASE("straight at 0.2 m/s for 10 s stays straight", "[sim][robot]") {
    for (const double heading : {0.0, 1.0}) {
        TryWorld w;
        w.add(mouse_spec(), 0, 0, heading);
        w.ramp(0, {0.2, 0.2}, 0.1);
        w.run(9.9);
        const Truth t = w.truth();
        const double along = t.pose.position.x * std::cos(heading) + t.pose.position.y * std::sin(heading);
        const double aside = -t.pose.position.x * std::sin(heading) + t.pose.position.y * std::cos(heading);
        CHECK(along == Approx(0.2 * 9.95).epsilon(1e-3));
        CHECK(std::abs(aside) < 1e-4);
        CHECK(t.pose.heading == Approx(heading).margin(1e-5));
    }
}

TEST_CASE("a robot turns on the spot about its axle", "[sim][robot]") {
    RobotSpec spec = mouse_spec();
    spec.body.at.x = 0.01;
    TryWorld w;
    w.add(spec, 0.5, 0.5);
    w.ramp(0, {-0.05, 0.05}, 0.2);
    w.run(1.9);
    CHECK(w.truth().pose.heading == Approx(0.1 / 0.0925 * 2.0).epsilon(0.01));
    CHECK(w.truth().pose.position.x == Approx(0.5).margin(1e-3));
    CHECK(w.truth().pose.position.y == Approx(0.5).margin(1e-3));
}

TEST_CASE("paths at the default step of 5 ms agree with those at 1 ms within 1 %", "[sim][robot]") {
    const auto drive = [](double step) {
        TryWorld w({}, step);
        w.add(mouse_spec(), 0, 0);
        w.ramp(0, {0.2, 0.2}, 0.1);
        w.run(1);
        w.ramp(0, {0.05, 0.25}, 0.1);
        w.run(2);
        w.ramp(0, {0.4, 0.3}, 0.2);
        w.run(2);
        return w;
    };
    const TryWorld coarse = drive(0.005), fine = drive(0.001);
    const Truth a = coarse.truth(), b = fine.truth();
    const double length = 0.2 * 1.1 + 0.15 * 2.1 + 0.35 * 2.2;
    CHECK(std::hypot(a.pose.position.x - b.pose.position.x, a.pose.position.y - b.pose.position.y) < 0.01 * length);
    const double turned = 0.2 / 0.0925 * 2;
    CHECK(std::abs(std::remainder(a.pose.heading - b.pose.heading, 2 * M_PI)) < 0.01 * turned);
}

TEST_CASE("simulated time and path do not depend on how many steps a call takes", "[sim][robot]") {
    TryWorld one, ten;
    for (TryWorld* w : {&one, &ten}) {
        w->add(mouse_spec(), 0, 0);
        w->bodies[0]->set_wheel_speeds({0.2, 0.25});
    }
    for (int i = 0; i < 200; ++i) one.world->step(1);
    for (int i = 0; i < 20; ++i) ten.world->step(10);
    CHECK(one.bits() == ten.bits());
}

TEST_CASE("wheels that slip against a wall keep counting, and the wall holds", "[sim][robot][fault]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.55, 0, 0.1}, .size = {0.1, 1, 0.2}});
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
        TryWorld w(arena);
        w.add(spec, 0, 0);
        w.ramp(0, {0.3, 0.3}, 0.15);
        w.run(10);
        const double front = w.truth().pose.position.x + spec.body.size.x / 2;
        CHECK(front == Approx(0.5).margin(0.003));
        CHECK(std::abs(w.truth().velocity.vx) < 1e-3);
        // Odometry is not the ground truth: 3 m were turned, 0.45 m driven.
        CHECK(w.bodies[0]->wheel_angles().left * spec.drive.radius == Approx(0.3 * 10.075).epsilon(1e-3));
        CHECK(w.truth().tilt < 0.1);
        CHECK(w.world->collided(0));
        CHECK(w.world->collided_with(0) == "box 1");
        w.ramp(0, {-0.3, -0.3}, 0.15);
        w.run(0.5);
        CHECK_FALSE(w.world->collided(0) == (w.truth().velocity.vx < -0.29));
        CHECK(w.world->collided_with(0).empty());
    }
}

TEST_CASE("wheels that stand out beside the hull stop at a wall beside them", "[sim][robot]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0, 0.2, 0.1}, .size = {4, 0.1, 0.2}});
    TryWorld w(arena);
    w.add(mouse_spec(), -1, 0.08, 0.1);
    w.ramp(0, {0.2, 0.2}, 0.1);
    double nearest = 1, tilt = 0;
    w.run(8, [&] {
        const Truth t = w.truth();
        nearest = std::min(nearest, 0.15 - (t.pose.position.y + 0.04625 * std::cos(t.pose.heading)));
        tilt = std::max(tilt, t.tilt);
    });
    CHECK(nearest > -0.003);
    CHECK(nearest < 0.001);
    CHECK(tilt < 0.1);
    CHECK(w.world->collided_with(0) == "box 1");
    CHECK(w.truth().pose.position.x > 0);            // it slides on along the wall
    CHECK(std::abs(w.truth().pose.heading) < 0.15);  // corner and wheel both touch
}

TEST_CASE("a robot that hits a wall at 1.5 m/s neither flips nor goes through", "[sim][robot][fault]") {
    for (const double thickness : {0.01, 0.1}) {
        ArenaSpec arena;
        arena.boxes.push_back({.at = {1 + thickness / 2, 0, 0.1}, .size = {thickness, 1, 0.2}});
        for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
            TryWorld w(arena);
            w.add(spec, 0, 0);
            w.bodies[0]->set_wheel_speeds({1.5, 1.5});
            double tilt = 0, farthest = 0;
            w.run(3, [&] {
                tilt = std::max(tilt, w.truth().tilt);
                farthest = std::max(farthest, w.truth().pose.position.x);
            });
            CHECK(tilt < 0.3);
            CHECK(farthest + spec.body.size.x / 2 < 1.01);
            CHECK(w.truth().pose.position.x + spec.body.size.x / 2 == Approx(1).margin(0.005));
        }
    }
}

TEST_CASE("a robot climbs a kerb of 5 mm at any speed, and a taller block stops it", "[sim][robot]") {
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
        for (const double speed : {0.05, 0.2, 0.5}) {
            ArenaSpec arena;
            arena.boxes.push_back({.at = {0.7, 0, 0.0025}, .size = {0.4, 1, 0.005}});
            TryWorld w(arena);
            w.add(spec, 0, 0);
            w.bodies[0]->set_wheel_speeds({speed, speed});
            double tilt = 0, top = 0;
            bool touched = false;
            w.run(1.2 / speed, [&] {
                tilt = std::max(tilt, w.truth().tilt);
                top = std::max(top, w.truth().height);
                touched = touched || w.world->collided(0);
            });
            CHECK(w.truth().pose.position.x == Approx(1.2).epsilon(0.03));
            CHECK(tilt < 0.25);
            CHECK(top > 0.0045);
            CHECK(top < 0.012);
            CHECK(std::abs(w.truth().height) < 1e-4);
            CHECK(touched);
        }
        ArenaSpec arena;
        arena.boxes.push_back({.at = {0.7, 0, 0.02}, .size = {0.4, 1, 0.04}});
        TryWorld w(arena);
        w.add(spec, 0, 0);
        w.bodies[0]->set_wheel_speeds({0.2, 0.2});
        w.run(5);
        CHECK(w.truth().pose.position.x + spec.body.size.x / 2 == Approx(0.5).margin(0.005));
    }
}

TEST_CASE("a mouse drives up a ramp of 10 degrees", "[sim][robot]") {
    const double slope = 10 * M_PI / 180;
    for (const double speed : {0.05, 0.2, 0.5}) {
        ArenaSpec arena;
        arena.boxes.push_back(
            {.at = {1, 0, 0.4 * std::sin(slope) - 0.05 * std::cos(slope)}, .size = {0.8, 1, 0.1}, .pitch = -slope});
        TryWorld w(arena);
        w.add(mouse_spec(), 0.3, 0);
        w.bodies[0]->set_wheel_speeds({speed, speed});
        w.run(0.9 / speed);
        CHECK(w.truth().height > 0.09);
        CHECK(w.truth().tilt == Approx(slope).margin(0.04));
        // It stays where it stops: a loaded wheel creeps no faster than this.
        w.bodies[0]->set_wheel_speeds({0, 0});
        w.run(0.5);
        CHECK(std::abs(w.truth().velocity.vx) < 0.003);
    }
}

TEST_CASE("a robot dropped on the floor comes to rest upright", "[sim][robot]") {
    // A block under the wheels puts it 5 cm up; it drives off the edge.
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0, 0, 0.0045}, .size = {0.3, 0.3, 0.009}});
    TryWorld w(arena);
    w.add(mouse_spec(), 0, 0);
    CHECK(w.truth().height == Approx(0.009).margin(1e-6));
    w.run(0.5);
    CHECK(w.truth().height == Approx(0.009).margin(1e-4));
    w.bodies[0]->set_wheel_speeds({0.5, 0.5});
    w.run(2);
    CHECK(std::abs(w.truth().height) < 1e-4);
    CHECK(w.truth().tilt < 1e-3);
}

TEST_CASE("a teleported robot is at rest, and its wheel angles do not change", "[sim][robot]") {
    ArenaSpec arena;
    arena.size = Point2D{4, 4};
    TryWorld w(arena);
    w.add(mouse_spec(), 0, 0);
    w.bodies[0]->set_wheel_speeds({0.3, 0.3});
    w.run(1);
    const Wheels angles = w.bodies[0]->wheel_angles();
    w.bodies[0]->set_wheel_speeds({0, 0});
    REQUIRE(w.world->teleport(0, {{-1, 1}, 2}));
    CHECK(w.truth().pose.position.x == Approx(-1));
    CHECK(w.truth().pose.position.y == Approx(1));
    CHECK(w.truth().pose.heading == Approx(2));
    CHECK(w.truth().velocity == Velocity2D{});
    CHECK(w.bodies[0]->wheel_angles() == angles);
    w.run(1);
    CHECK(w.truth().pose.position.x == Approx(-1).margin(1e-6));

    const auto refused = w.world->teleport(0, {{1.99, 0}, 0});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "robot 'robot0' at x = 1.99, y = 0 overlaps the arena's wall: move one of them");
    CHECK(w.truth().pose.position.x == Approx(-1).margin(1e-6));
    CHECK_FALSE(w.world->teleport(0, {{NAN, 0}, 0}));
}

TEST_CASE("no robot starts or is placed outside an arena with a border", "[sim][robot]") {
    for (const bool border : {true, false}) {
        ArenaSpec arena;
        arena.size = Point2D{2, 2};
        if (!border) arena.border.reset();
        TryWorld w(arena);
        w.add(mouse_spec(), 0, 0);
        const RobotSpec other = mouse_spec();
        auto outside = w.world->add_robot("other", other, {{5, 0}, 0});
        const auto moved = w.world->teleport(0, {{0, -1.5}, 0});
        CHECK(outside.has_value() != border);
        CHECK(moved.has_value() != border);
        if (!border) continue;
        CHECK(outside.error().message ==
              "robot 'other' at x = 5, y = 0 is outside the arena of 2 x 2 m: put it inside, or set border = false");
        CHECK(
            moved.error().message ==
            "robot 'robot0' at x = 0, y = -1.5 is outside the arena of 2 x 2 m: put it inside, or set border = false");
        CHECK(w.truth().pose.position.y == Approx(0).margin(1e-9));
    }
}

TEST_CASE("the less friction its wheels have, the longer a robot slides", "[sim][robot]") {
    const auto way_to_stand = [](double friction) {
        RobotSpec spec = mouse_spec();
        spec.friction = friction;
        TryWorld world;
        const RobotId id = world.add(spec, 0, 0);
        world.ramp(id, {0.4, 0.4}, 4);
        const double speed = world.truth(id).velocity.vx;
        const double from = world.truth(id).pose.position.x;
        world.bodies[id]->set_wheel_speeds({});
        world.run(3);
        CHECK(std::abs(world.truth(id).velocity.vx) < 1e-3);
        return (world.truth(id).pose.position.x - from) / (speed * speed);
    };
    // Coulomb: v^2 / (2 mu g), with 70 % of the weight on the wheels.
    CHECK(way_to_stand(0.1) == Approx(1 / (2 * 0.1 * 0.7 * 9.81)).epsilon(0.2));
    CHECK(way_to_stand(0.05) == Approx(1 / (2 * 0.05 * 0.7 * 9.81)).epsilon(0.2));
    CHECK(way_to_stand(1) < 0.2);
}
