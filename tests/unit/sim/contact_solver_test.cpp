// Robots that touch fixed things move as with ODE's solver.
#include "sim/contact_solver.hpp"

#include <cmath>
#include <random>

#include "tests/unit/sim/two_ways.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

// Robots among walls, ramps, kerbs and posts that touch their place at random, moving at random.
struct RandomPlace {
    std::mt19937_64 random{11};

    double between(double least, double most) { return std::uniform_real_distribution(least, most)(random); }
    bool chance(double part) { return between(0, 1) < part; }

    // A wall at this angle [rad] from the middle, which touches a robot there.
    BoxSpec wall(const RobotSpec& spec, double angle, double heading) {
        const Vec3 half = to_vec(spec.body.size) / 2;
        const double beside = std::max(half.y(), spec.drive.track / 2);
        const bool is_box = spec.body.shape == BodySpec::Shape::box;
        const double reach =
            is_box ? half.x() * std::abs(std::cos(angle - heading)) + beside * std::abs(std::sin(angle - heading))
                   : half.x();
        const double away = reach + 0.05 + between(-0.003, 0.001);
        return {.at = {away * std::cos(angle), away * std::sin(angle), 0.1},
                .size = {0.1, between(0.05, 1), 0.2},
                .yaw = angle};
    }
    ArenaSpec arena(const RobotSpec& spec, double heading) {
        ArenaSpec arena;
        const auto walls = static_cast<int>(random() % 4);
        for (int i = 0; i < walls; ++i) arena.boxes.push_back(wall(spec, between(-M_PI, M_PI), heading));
        const double x = between(-0.1, 0.1), y = between(-0.1, 0.1), yaw = between(-M_PI, M_PI);
        if (walls == 0 || chance(0.3))  // a kerb or a ramp
            arena.boxes.push_back({.at = {x, y, 0},
                                   .size = {0.2, 0.2, between(0.002, 0.01)},
                                   .yaw = yaw,
                                   .pitch = chance(0.5) ? between(0.02, 0.1) : 0});
        if (chance(0.2)) arena.cylinders.push_back({.at = {x, y, 0.0}, .radius = 0.05, .height = 0.006});
        return arena;
    }
    void put(Pair& pair, double heading) {
        const double height = pair.own.robot(0).body.p[2];
        const Vec3 centre{between(-0.002, 0.002), between(-0.002, 0.002), height + between(-5e-4, 5e-4)};
        const Rotation rotation = yaw_pitch_rotation(heading + between(-0.02, 0.02), between(-0.02, 0.02)) *
                                  Eigen::AngleAxisd(between(-0.02, 0.02), Vec3::UnitX()).toRotationMatrix();
        const double speed = chance(0.5) ? 0.3 : 0.01;
        const Vec3 velocity{between(-speed, speed), between(-speed, speed), between(-0.02, 0.02)};
        const Vec3 spin{between(-0.2, 0.2), between(-0.2, 0.2), between(-speed, speed) * 10};
        for (OdeWorld* world : {&pair.own, &pair.ode}) {
            const BodyView& body = world->robot(0).body;
            REQUIRE(world->teleport(0, {{5, 5}, 0}));
            body.put(centre, rotation);
            dBodySetLinearVel(body.id, velocity.x(), velocity.y(), velocity.z());
            dBodySetAngularVel(body.id, spin.x(), spin.y(), spin.z());
        }
        if (chance(0.1)) {
            for (const auto& body : pair.bodies) body->coast();
        } else if (chance(0.2)) {
            pair.drive({});
        } else {
            pair.drive({between(-0.5, 0.5), between(-0.5, 0.5)});
        }
    }
};

}  // namespace

TEST_CASE("a step among fixed things equals ODE's to 1e-12 from thirty thousand states", "[sim][contacts]") {
    RandomPlace place;
    RobotSpec slippery = swarm_spec();
    slippery.friction = 0.2;
    double most = 0;
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec(), odd_spec(), slippery}) {
        int met = 0, by_ode = 0;
        for (int i = 0; i < 150; ++i) {
            const double heading = place.between(-M_PI, M_PI);
            Pair pair(spec, place.chance(0.5) ? 0.01 : step, place.arena(spec, heading), {{5, 5}, 0});
            for (int k = 0; k < 50; ++k) {
                place.put(pair, heading);
                pair.take_step();
                met += pair.own.collided(0) ? 1 : 0;
                by_ode += pair.own.robot(0).by_ode ? 1 : 0;
                const double difference = pair.difference();
                if (!(difference < 1e-12)) FAIL_CHECK("try " << k << " in arena " << i << " differs by " << difference);
                most = std::max(most, difference);
            }
        }
        CAPTURE(spec.model, met, by_ode);
        CHECK(met > 4000);
        CHECK(by_ode < 10);  // where the search for the active bounds took too long
    }
    WARN("a step differs by " << most << " at most");
}

TEST_CASE("slipping wheels, coasting wheels, walls and ramps need no ODE; a pushed robot needs it", "[sim][contacts]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {1, 0, 0.1}, .size = {0.1, 1, 0.2}});
    arena.boxes.push_back({.at = {-1, 0, 0}, .size = {0.5, 1, 0.1}, .pitch = 0.1});
    const auto needs_ode = [&](auto&& prepare, double friction = 1) {
        RobotSpec spec = mouse_spec();
        spec.friction = friction;
        Pair pair(spec, step, arena);
        for (int i = 0; i < 100; ++i) pair.take_step();
        REQUIRE(pair.can_roll());  // at rest
        prepare(pair);
        bool needs = false;
        for (int i = 0; i < 400; ++i) {
            pair.take_step();
            needs = needs || pair.own.robot(0).by_ode;
        }
        CHECK(pair.difference() < 1e-9);
        return needs;
    };
    CHECK_FALSE(needs_ode([](Pair& pair) { pair.drive({0.01, 0.01}); }));
    CHECK_FALSE(needs_ode([](Pair& pair) { pair.drive({0.2, 0.2}); }, 0.02));
    CHECK_FALSE(needs_ode([](Pair& pair) {
        for (const auto& body : pair.bodies) body->coast();
    }));
    CHECK(needs_ode([](Pair& pair) {
        pair.own.disturb(0, {.vx = 0.1});
        pair.ode.disturb(0, {.vx = 0.1});
    }));
    for (const double x : {0.88, -0.6}) {  // into the wall, up the ramp
        CHECK_FALSE(needs_ode([x](Pair& pair) {
            CHECK(pair.own.teleport(0, {{x, 0}, x > 0 ? 0 : M_PI}));
            CHECK(pair.ode.teleport(0, {{x, 0}, x > 0 ? 0 : M_PI}));
            pair.drive({0.1, 0.1});
        }));
    }
}

TEST_CASE("a robot with more contacts than the solver has room for moves by ODE", "[sim][contacts]") {
    const RobotSpec spec = swarm_spec();
    const RobotModel model(spec, step);
    dContact contact = model.skid_contact;
    contact.geom.normal[2] = 1;
    contact.geom.depth = 1e-4;
    const BodyState body{{0, 0, 0.04}, Rotation::Identity(), {1, 0, 0, 0}, {Vec3::Zero(), Vec3::Zero()}};
    std::vector<dContact> contacts(most_solved_contacts, contact);
    CHECK(solve_contacts(model, body, contacts, step));
    contacts.push_back(contact);
    CHECK_FALSE(solve_contacts(model, body, contacts, step));
}

TEST_CASE("robots that touch a thing or each other move by ODE, and alone again when they have parted",
          "[sim][contacts]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {1, 0, 0.05}, .size = {0.1, 0.1, 0.1}, .mass = 0.3});
    OdeWorld world(arena, {.step = step, .seed = 1}, nullptr);
    const RobotSpec spec = swarm_spec();
    const auto a = world.add_robot("a", spec, {{0, 0}, 0}).value(),
               b = world.add_robot("b", spec, {{0.2, 0}, 0}).value(),
               c = world.add_robot("c", spec, {{0.85, 0}, 0}).value();
    a->set_wheel_speeds({0.1, 0.1});
    c->set_wheel_speeds({0.1, 0.1});
    world.step(120);
    REQUIRE(world.collided(0));
    REQUIRE(world.collided_with(2) == "box 1");
    for (RobotId i = 0; i < 3; ++i) CHECK(world.robot(i).by_ode);
    a->set_wheel_speeds({-0.1, -0.1});
    c->set_wheel_speeds({-0.1, -0.1});
    world.step(120);
    for (RobotId i = 0; i < 3; ++i) CHECK_FALSE(world.robot(i).by_ode);
}
