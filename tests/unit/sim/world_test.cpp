// Robots and things together: collisions, pushing, piles, determinism.
#include "tests/unit/sim/try_world.hpp"

#include <algorithm>
#include <ctime>
#include <random>
#include <thread>

using namespace nezumi;
using namespace nezumi::sim;

namespace {

// Twelve discs and mice that collide with each other, a wall and movable things: islands of every size.
TryWorld make_crowd(std::uint64_t seed) {
    ArenaSpec arena;
    arena.size = Point2D{1.6, 1.6};
    arena.boxes.push_back({.at = {0, 0, 0.05}, .size = {0.1, 0.2, 0.1}, .yaw = 0.3, .mass = 0.3});
    arena.cylinders.push_back({.at = {0.25, 0.2, 0.05}, .radius = 0.04, .height = 0.1, .mass = 0.2});
    const RobotSpec disc = swarm_spec(), mouse = mouse_spec();
    TryWorld w(arena, 0.005, seed);
    for (int i = 0; i < 12; ++i) {
        const double angle = i * M_PI / 6;
        w.add(i % 2 == 0 ? disc : mouse, 0.6 * std::cos(angle), 0.6 * std::sin(angle), angle + M_PI);
        w.bodies.back()->set_wheel_speeds({0.3, 0.3 + 0.01 * i});
    }
    return w;
}

}  // namespace

TEST_CASE("robots that overlap anything at the start are refused, with both names", "[sim][world]") {
    ArenaSpec arena;
    arena.size = Point2D{2, 2};
    arena.boxes.push_back({.at = {0.5, 0, 0.1}, .size = {0.1, 0.1, 0.2}});
    arena.cylinders.push_back({.at = {-0.5, 0, 0.1}, .radius = 0.05, .height = 0.2, .mass = 0.1});
    TryWorld w(arena);
    const RobotSpec mouse = mouse_spec();
    w.add(mouse, 0, 0, 0, "mouse");
    const auto refusal = [&](double x, double y) {
        const auto body = w.world->add_robot("other", mouse, {{x, y}, 0});
        return body ? std::string("added") : body.error().message;
    };
    CHECK(refusal(0.09, 0.0) == "robot 'other' at x = 0.09, y = 0 overlaps robot 'mouse': move one of them");
    CHECK(refusal(0.41, 0.0) == "robot 'other' at x = 0.41, y = 0 overlaps box 1: move one of them");
    CHECK(refusal(-0.42, 0.0) == "robot 'other' at x = -0.42, y = 0 overlaps cylinder 1: move one of them");
    CHECK(refusal(0, 0.97) == "robot 'other' at x = 0, y = 0.97 overlaps the arena's wall: move one of them");
    CHECK(refusal(INFINITY, 0).find("finite") != std::string::npos);
    CHECK(refusal(0.1001, 0.0) == "added");
}

TEST_CASE("an object without size is refused with its location", "[sim][world]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {}, .size = {1, 0, 1}, .place = {"arena.lua", 3}});
    auto made = make_world(arena, {}, {});
    REQUIRE_FALSE(made);
    CHECK(describe(made.error()) == "arena.lua:3: box: field 'size.y' expected a positive number, got 0");
    arena = {};
    arena.cylinders.push_back({.at = {}, .radius = -1, .height = 1, .place = {"arena.lua", 4}});
    made = make_world(arena, {}, {});
    REQUIRE_FALSE(made);
    CHECK(describe(made.error()) == "arena.lua:4: cylinder: field 'radius' expected a positive number, got -1");
    made = make_world({}, {.step = 0}, {});
    REQUIRE_FALSE(made);
    CHECK(describe(made.error()) == "physics: the step: expected a positive number, got 0");
    made = make_world({.size = Point2D{1, 1e300}}, {}, {});
    REQUIRE_FALSE(made);
    CHECK(describe(made.error()) == "arena: field 'size.y' expected a number up to 1000000, got 1e+300");
    made = make_world({.border = BorderSpec{.thickness = 1e-300}}, {}, {});
    REQUIRE_FALSE(made);
    CHECK(describe(made.error()) == "arena: field 'border.thickness' expected at least 0.0001 m, got 1e-300");
}

TEST_CASE("when two robots touch, each one reports the other", "[sim][world]") {
    const RobotSpec mouse = mouse_spec(), disc = swarm_spec();
    for (const RobotSpec* spec : {&mouse, &disc}) {
        TryWorld w;
        w.add(*spec, -0.3, 0, 0, "left");
        w.add(*spec, 0.3, 0, M_PI, "right");
        w.add(*spec, 0, 1, 0, "far");
        w.bodies[0]->set_wheel_speeds({0.2, 0.2});
        w.run(1);
        CHECK_FALSE(w.world->collided(0));
        w.run(2);
        w.bodies[1]->set_wheel_speeds({0.01, 0.01});
        w.run(0.5);
        CHECK(w.world->collided_with(0) == "right");
        CHECK(w.world->collided_with(1) == "left");
        CHECK_FALSE(w.world->collided(2));
        // Hulls touch without overlapping; while pushing, they lean slightly.
        CHECK(w.truth(1).pose.position.x - w.truth(0).pose.position.x == Approx(spec->body.size.x).margin(0.005));
    }
}

TEST_CASE("a disc does not slip past another that it meets head-on", "[sim][world]") {
    const RobotSpec disc = swarm_spec();
    for (const double speed : {0.05, 0.5, 1.5}) {
        TryWorld w;
        w.add(disc, -0.4, 0);
        w.add(disc, 0.4, 0, M_PI);
        w.bodies[0]->set_wheel_speeds({speed, speed});
        w.bodies[1]->set_wheel_speeds({speed, speed});
        double tilt = 0, nearest = 1;
        w.run(1 / speed + 1, [&] {
            tilt = std::max({tilt, w.truth(0).tilt, w.truth(1).tilt});
            nearest = std::min(nearest, std::hypot(w.truth(1).pose.position.x - w.truth(0).pose.position.x,
                                                   w.truth(1).pose.position.y - w.truth(0).pose.position.y));
        });
        CHECK(w.truth(0).pose.position.x < 0);
        CHECK(w.truth(1).pose.position.x > 0);
        CHECK(nearest > 0.155);
        CHECK(tilt < 0.2);
    }
}

TEST_CASE("a robot pushes a movable box, but not a too heavy one", "[sim][world]") {
    const RobotSpec mouse = mouse_spec();
    for (const double mass : {0.2, 20.0}) {
        ArenaSpec arena;
        arena.boxes.push_back({.at = {0.3, 0, 0.05}, .size = {0.1, 0.1, 0.1}, .mass = mass});
        TryWorld w(arena);
        w.add(mouse, 0, 0);
        w.run(1);
        CHECK(w.world->things()[0].pose.position.x == Approx(0.3).margin(1e-5));
        w.ramp(0, {0.2, 0.2}, 0.1);
        w.run(4);
        const ThingPose box = w.world->things()[0];
        CHECK(w.world->collided_with(0) == "box 1");
        if (mass < 1) {
            CHECK(box.pose.position.x > 0.8);
            CHECK(box.pose.position.x - w.truth().pose.position.x == Approx(0.1).margin(0.003));
        } else {
            CHECK(box.pose.position.x == Approx(0.3).margin(1e-3));
        }
        CHECK(box.pose.position.z == Approx(0.05).margin(1e-3));
        // After the release it comes to rest and stays.
        w.ramp(0, {-0.2, -0.2}, 0.2);
        w.run(1);
        const double x = w.world->things()[0].pose.position.x;
        w.run(5);
        CHECK(w.world->things()[0].pose.position.x == x);
    }
}

TEST_CASE("a movable cylinder can be pushed and knocked over", "[sim][world]") {
    const RobotSpec disc = swarm_spec();
    ArenaSpec arena;
    arena.cylinders.push_back({.at = {0.3, 0, 0.1}, .radius = 0.02, .height = 0.2, .mass = 0.1});
    TryWorld w(arena);
    w.add(disc, 0, 0);
    w.run(2);
    CHECK(w.world->things()[0].pose.position.z == Approx(0.1).margin(1e-3));
    w.bodies[0]->set_wheel_speeds({0.5, 0.5});
    w.run(3);
    const ThingPose thing = w.world->things()[0];
    CHECK(thing.pose.position.x > 0.4);
    CHECK(thing.pose.position.z > 0.01);
    CHECK(thing.pose.position.z < 0.11);
    CHECK(thing.shape == ThingPose::Shape::cylinder);
    CHECK(w.warnings->empty());
}

TEST_CASE("movable boxes stack, sleep and wake", "[sim][world]") {
    const RobotSpec mouse = mouse_spec();
    ArenaSpec arena;
    for (int i = 0; i < 3; ++i)
        arena.boxes.push_back({.at = {0.4, 0, 0.03 + 0.061 * i}, .size = {0.06, 0.06, 0.06}, .mass = 0.1});
    TryWorld w(arena);
    w.add(mouse, 0, 0);
    w.run(3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(w.world->things()[i].pose.position.z == Approx(0.03 + 0.06 * static_cast<double>(i)).margin(2e-3));
        CHECK(w.world->things()[i].pose.position.x == Approx(0.4).margin(2e-3));
    }
    w.bodies[0]->set_wheel_speeds({0.5, 0.5});
    w.run(4);
    for (const ThingPose& thing : w.world->things()) {  // the tower falls; nothing hangs in the air
        CHECK(thing.pose.position.z > 0.02);
        CHECK(thing.pose.position.z < 0.16);
    }
    CHECK(w.world->things()[0].pose.position.x > 0.6);
}

TEST_CASE("the same seed gives the same bits", "[sim][determinism]") {
    TryWorld a = make_crowd(5), b = make_crowd(5);
    a.run(5);
    b.run(5);
    CHECK(a.bits() == b.bits());
    CHECK(a.bits().front() != 0);
}

TEST_CASE("bits do not depend on how many steps a call takes", "[sim][determinism]") {
    for (const std::uint64_t seed : {5, 6, 7}) {
        TryWorld once = make_crowd(seed), tens = make_crowd(seed), ones = make_crowd(seed);
        once.world->step(1000);
        for (int i = 0; i < 100; ++i) tens.world->step(10);
        for (int i = 0; i < 1000; ++i) ones.world->step(1);
        CHECK(once.bits() == tens.bits());
        CHECK(once.bits() == ones.bits());
    }
}

TEST_CASE("two worlds interleaved in one process give the same bits as alone", "[sim][determinism]") {
    TryWorld alone = make_crowd(5), other_alone = make_crowd(6);
    alone.run(4);
    other_alone.run(4);
    TryWorld a = make_crowd(5), b = make_crowd(6);
    for (int i = 0; i < 80; ++i) {
        a.world->step(10);
        b.world->step(10);
    }
    CHECK(a.bits() == alone.bits());
    CHECK(b.bits() == other_alone.bits());
}

TEST_CASE("worlds on several threads give the same bits as alone", "[sim][determinism]") {
    TryWorld alone = make_crowd(5);
    alone.run(3);
    std::vector<std::vector<double>> bits(3);
    std::vector<TryWorld> worlds;
    for (int i = 0; i < 3; ++i) worlds.push_back(make_crowd(5));  // Catch's REQUIRE is for one thread
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < 3; ++i) {
        threads.emplace_back([&, i] {
            worlds[i].run(3);
            bits[i] = worlds[i].bits();
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : bits) CHECK(result == alone.bits());
}

TEST_CASE("many robots in a pile stay finite, upright and within the walls", "[sim][world]") {
    const RobotSpec disc = swarm_spec(), mouse = mouse_spec();
    ArenaSpec arena;
    arena.size = Point2D{1.4, 1.4};
    TryWorld w(arena);
    for (int i = 0; i < 25; ++i) {
        w.add(i % 3 == 0 ? mouse : disc, 0.22 * (i % 5 - 2), 0.22 * (i / 5 - 2), i);
    }
    // All drive to the middle, repeatedly, at speeds beyond any limit.
    double tilt = 0;
    std::mt19937 random(1);
    for (int k = 0; k < 40; ++k) {
        for (auto& body : w.bodies) {
            const double a = static_cast<double>(random() % 300) / 100 - 1.5,
                         b = static_cast<double>(random() % 300) / 100 - 1.5;
            body->set_wheel_speeds({a, b});
        }
        w.run(0.25);
        for (RobotId i = 0; i < w.bodies.size(); ++i) tilt = std::max(tilt, w.truth(i).tilt);
    }
    for (RobotId i = 0; i < w.bodies.size(); ++i) {
        const Truth t = w.truth(i);
        CHECK(std::abs(t.pose.position.x) < 0.7);
        CHECK(std::abs(t.pose.position.y) < 0.7);
        CHECK(std::abs(t.height) < 0.02);
    }
    CHECK(tilt < 0.6);
    CHECK(w.warnings->empty());
}

TEST_CASE("sensors see walls, boxes, cylinders and other robots, but not their own robot", "[sim][sensor]") {
    const RobotSpec mouse = mouse_spec();
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.535 + 0.05, 0, 0.1}, .size = {0.1, 1, 0.2}});
    TryWorld w(arena);
    w.add(mouse, 0, 0);
    std::vector<double> seen(4);
    w.bodies[0]->read_ranges(seen);
    CHECK(seen[0] == Approx(0.5).margin(1e-6));
    CHECK(seen[3] == Approx(0.5).margin(1e-6));
    // 45 degrees: from (0.045, 0.03) the wall at 0.535 is 0.49 * sqrt(2) away, out of its 0.6 m.
    CHECK(seen[1] == INFINITY);
    w.add(mouse, 0.285, 0.04);  // its rear at 0.235, before the left front sensor
    w.bodies[0]->read_ranges(seen);
    CHECK(seen[0] == Approx(0.5).margin(1e-6));
    CHECK(seen[3] == Approx(0.2).margin(1e-6));
    w.run(0.5);
    w.bodies[0]->read_ranges(seen);
    CHECK(seen[3] == Approx(0.2).margin(1e-5));
    const std::vector<Ray> rays = w.world->rays(0);
    REQUIRE(rays.size() == 4);
    CHECK(rays[3].hit);
    CHECK(rays[3].from.x == Approx(0.035).margin(1e-5));
    CHECK(rays[3].to.x == Approx(0.235).margin(1e-5));
    CHECK_FALSE(rays[1].hit);
    REQUIRE(w.world->teleport(1, {{-1, 0}, 0}));
    w.bodies[0]->read_ranges(seen);
    CHECK(seen[3] == Approx(0.5).margin(1e-5));
}

TEST_CASE("a sensor on a servo turns with the servo", "[sim][sensor]") {
    RobotSpec spec = mouse_spec();
    ActuatorSpec servo;
    servo.name = "neck";
    servo.kind = ActuatorSpec::Kind::servo;
    servo.at = {0.02, 0, 0.05};
    spec.actuators.push_back(servo);
    spec.sensors.resize(1);
    spec.sensors[0].on = "neck";
    spec.sensors[0].at = {0.04, 0, 0.05};
    spec.sensors[0].range = 2;
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0, 1.05, 0.1}, .size = {4, 0.1, 0.2}});
    TryWorld w(arena);
    w.add(spec, 0, 0);
    std::vector<double> seen(1);
    w.bodies[0]->read_ranges(seen);
    CHECK(seen[0] == INFINITY);
    w.bodies[0]->set_servo(0, M_PI / 2);
    w.bodies[0]->read_ranges(seen);
    CHECK(seen[0] == Approx(0.98).margin(1e-6));  // 0.02 m before the neck's axis
}

TEST_CASE("a touch sensor closes by contact and by a press, a button by a press only", "[sim][sensor]") {
    RobotSpec spec = mouse_spec();
    SensorSpec touch;
    touch.name = "bumper";
    touch.kind = SensorSpec::Kind::touch;
    touch.at = {0.054, 0.02, 0.04};
    touch.travel = 0.004;
    spec.sensors.push_back(touch);
    touch.name = "button";
    touch.kind = SensorSpec::Kind::button;
    spec.sensors.push_back(touch);
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.25, 0, 0.1}, .size = {0.1, 1, 0.2}});
    TryWorld w(arena);
    w.add(spec, 0, 0);
    CHECK_FALSE(w.bodies[0]->is_pressed(4));
    w.bodies[0]->set_wheel_speeds({0.1, 0.1});
    double closed_at = 0;
    w.run(2, [&] {
        if (closed_at == 0 && w.bodies[0]->is_pressed(4)) closed_at = w.truth().pose.position.x;
    });
    CHECK(closed_at == Approx(0.15).margin(0.002));
    CHECK(w.bodies[0]->is_pressed(4));
    CHECK_FALSE(w.bodies[0]->is_pressed(5));
    w.bodies[0]->set_wheel_speeds({-0.1, -0.1});
    w.run(0.5);
    CHECK_FALSE(w.bodies[0]->is_pressed(4));
    w.world->press(0, 4, true);
    w.world->press(0, 5, true);
    CHECK(w.bodies[0]->is_pressed(4));
    CHECK(w.bodies[0]->is_pressed(5));
    w.world->press(0, 5, false);
    CHECK_FALSE(w.bodies[0]->is_pressed(5));
}

TEST_CASE("a gyro feels the yaw rate", "[sim][sensor]") {
    TryWorld w;
    w.add(mouse_spec(), 0, 0);
    w.bodies[0]->set_wheel_speeds({-0.05, 0.05});
    w.run(1);
    CHECK(w.bodies[0]->yaw_rate() == Approx(0.1 / 0.0925).epsilon(0.001));
}

TEST_CASE("the time to add ten thousand robots is proportional to their number", "[sim][world][wallclock]") {
    const auto seconds = [](int count) {
        const RobotSpec disc = swarm_spec();
        TryWorld w;
        w.bodies.reserve(10000);
        const auto begin = std::clock();
        for (int i = 0; i < count; ++i) w.add_kept(disc, 0.3 * (i % 100), 0.3 * (i / 100), 0, "r");
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    // Of the processor's time, the least of some tries: with the square of the number this would be a hundred times.
    const double few = std::min(seconds(1000), seconds(1000));
    CHECK(std::min({seconds(10000), seconds(10000), seconds(10000)}) < 40 * few + 0.1);
}
