// Robots that roll freely move as with ODE's solver.
#include <algorithm>
#include <cmath>
#include <random>

#include "engine/base/worker_pool.hpp"
#include "sim/free_rolling.hpp"
#include "sim/ode_world.hpp"
#include "tests/unit/sim/two_ways.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

// A random pose with some pitch and roll, moving as its wheels turn.
struct RandomState {
    std::mt19937_64 random{17};
    double height = 0;  // [m] of the centre at rest

    double within(double most) { return std::uniform_real_distribution(-most, most)(random); }

    void put(Pair& pair) {
        const Wheels speeds{within(0.5), within(0.5)};
        const double heading = within(M_PI), track = pair.spec.drive.track;
        const Rotation rotation = yaw_pitch_rotation(heading, within(0.02)) *
                                  Eigen::AngleAxisd(within(1e-3), Vec3::UnitX()).toRotationMatrix();
        const double vx = (speeds.left + speeds.right) / 2 + within(0.02);
        const Vec3 velocity = rotate(rotation, {vx, within(0.01), within(0.01)});
        const Vec3 spin{within(0.1), within(0.1), (speeds.right - speeds.left) / track + within(0.1)};
        const Vec3 centre{within(5), within(5), height + within(1e-4)};
        for (OdeWorld* world : {&pair.own, &pair.ode}) {
            const BodyView& body = world->robot(0).body;
            body.put(centre, rotation);
            dBodySetLinearVel(body.id, velocity.x(), velocity.y(), velocity.z());
            dBodySetAngularVel(body.id, spin.x(), spin.y(), spin.z());
        }
        pair.drive(speeds);
    }
};

// Random driving speeds [m/s], now and then changed at once.
struct RandomDriver {
    std::mt19937_64 random{5};
    Wheels speeds{}, wanted{};

    Wheels next() {
        std::uniform_real_distribution<double> any(-0.4, 0.4);
        if (random() % 200 == 0) wanted = {any(random), any(random)};
        if (random() % 2000 == 0) speeds = wanted;  // a sudden change
        const auto follow = [](double& speed, double to) { speed += std::clamp(to - speed, -0.01, 0.01); };
        follow(speeds.left, wanted.left);
        follow(speeds.right, wanted.right);
        return speeds;
    }
};

// Robots that drive at random, collide with each other and with boxes, and are sometimes pushed.
struct Crowd {
    explicit Crowd(std::size_t count, WorkerPool* threads = nullptr)
        : world(arena(count), {.step = 0.01, .seed = 1}, nullptr), spec(swarm_spec()) {
        world.use_threads(threads);
        const auto columns = static_cast<std::size_t>(std::sqrt(count)) + 1;
        for (std::size_t i = 0; i < count; ++i) {
            const Point2D at{0.5 * static_cast<double>(i % columns), 0.5 * static_cast<double>(i / columns)};
            bodies.push_back(world.add_robot(std::to_string(i), spec, {at, static_cast<double>(i)}).value());
        }
    }

    static ArenaSpec arena(std::size_t count) {
        ArenaSpec arena;
        for (std::size_t i = 0; i < count / 10; ++i) {
            const double x = 0.25 + 0.5 * static_cast<double>(i);
            arena.boxes.push_back({.at = {x, 0.25, 0.05}, .size = {0.1, 0.1, 0.1}, .mass = i % 2 == 0 ? 0.3 : 0.0});
        }
        return arena;
    }

    // Ten steps, in one call or in ten.
    void tick(bool at_once) {
        std::uniform_real_distribution<double> any(-0.3, 0.3);
        for (const auto& body : bodies) {
            if (random() % 10 == 0) body->set_wheel_speeds({any(random), any(random)});
        }
        const RobotId pushed = random() % bodies.size();
        if (random() % 10 == 0) world.disturb(pushed, {.vx = 3.0});
        for (int i = 0; i < (at_once ? 1 : 10); ++i) world.step(at_once ? 10 : 1);
        world.disturb(pushed, {});
    }

    bool is_where(const Crowd& other) const {
        bool same = true;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const SimRobot &a = world.robot(i), &b = other.world.robot(i);
            same = same && a.body.centre() == b.body.centre() && a.body.rotation() == b.body.rotation() &&
                   a.body.velocity() == b.body.velocity() && a.body.spin() == b.body.spin() && a.angles == b.angles;
        }
        return same;
    }

    OdeWorld world;
    RobotSpec spec;
    std::vector<std::unique_ptr<RobotBody>> bodies;
    std::mt19937_64 random{7};
};

// Twenty robots for ten seconds: each drives until it collides with something, then turns away.
struct Bustle {
    double speed = 0;       // [m/s] mean
    double collisions = 0;  // per robot and minute
    double spread = 0;      // [m] root mean square distance from the middle at the end
};

Bustle bustle(std::uint64_t seed, bool by_ode) {
    constexpr std::size_t count = 20;
    constexpr double seconds = 10, length = 0.01;
    ArenaSpec arena;
    arena.size = {3, 3};
    arena.border = BorderSpec{};
    OdeWorld world(arena, {.step = length, .seed = seed}, nullptr);
    const RobotSpec spec = swarm_spec();
    std::mt19937_64 random{seed};
    std::vector<std::unique_ptr<RobotBody>> bodies;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = -1 + 0.5 * static_cast<double>(i % 5), y = -0.9 + 0.6 * static_cast<double>(i / 5);
        bodies.push_back(
            world.add_robot(std::to_string(i), spec, {{x, y}, static_cast<double>(random() % 628) / 100}).value());
        world.robot(i).kept_by_ode = by_ode;
    }
    std::vector<int> turning(count, 0);
    std::vector<bool> touched(count, false);
    Bustle all;
    const int ticks = static_cast<int>(seconds / length / 10);
    for (int tick = 0; tick < ticks; ++tick) {
        for (std::size_t i = 0; i < count; ++i) {
            const bool touches = world.collided(i);
            if (touches && !touched[i]) all.collisions += 1;
            touched[i] = touches;
            if (touches) turning[i] = 10 + static_cast<int>(random() % 20);
            bodies[i]->set_wheel_speeds(turning[i] > 0 ? Wheels{-0.1, 0.05} : Wheels{0.15, 0.15});
            if (turning[i] > 0) --turning[i];
            all.speed += world.robot(i).body.velocity().norm();
        }
        world.step(10);
    }
    for (std::size_t i = 0; i < count; ++i) all.spread += world.robot(i).body.centre().head<2>().squaredNorm();
    all.speed /= static_cast<double>(count) * ticks;
    all.collisions /= static_cast<double>(count) * seconds / 60;
    all.spread = std::sqrt(all.spread / count);
    return all;
}

}  // namespace

TEST_CASE("a step in closed form equals ODE's to 1e-12 from a hundred thousand states", "[sim][rolling]") {
    RandomState state;
    double most = 0;
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec(), odd_spec()}) {
        Pair pair(spec);
        state.height = pair.own.robot(0).body.p[2];
        int rolled = 0, tried = 0;
        while (rolled < 34'000 && tried < 340'000) {
            ++tried;
            state.put(pair);
            if (!pair.can_roll()) continue;
            pair.take_step();
            ++rolled;
            const double difference = pair.difference();
            if (!(difference < 1e-12)) FAIL_CHECK("try " << tried << " differs by " << difference);
            most = std::max(most, difference);
        }
        CAPTURE(spec.model, tried, rolled, most);
        CHECK(rolled >= 34'000);
    }
    WARN("a step differs by " << most << " at most");
}

TEST_CASE(
    "robots side by side take their steps as each alone does, to the last bit, also beside one that stops rolling",
    "[sim][rolling]") {
    RandomState state;
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec(), odd_spec()}) {
        Pair pair(spec);
        const SimRobot& robot = pair.own.robot(0);
        state.height = robot.body.p[2];
        int rolled = 0, stopped = 0;
        bool same = true;
        for (int i = 0; i < 1000; ++i) {
            std::array<Rolling, Lanes::count> together;
            for (Rolling& each : together) {
                state.put(pair);
                each = {robot.body.state(), robot.speeds};
            }
            if (i % 2 == 0) together[state.random() % Lanes::count].speeds.left += 2;  // it slips
            auto alone = together;
            std::array<double, 10> fastest{}, fastest_alone{};
            roll_freely(*robot.model, together, step, fastest);
            for (Rolling& each : alone) roll_freely(*robot.model, std::span(&each, 1), step, fastest_alone);
            same = same && fastest == fastest_alone;
            for (std::size_t k = 0; k < alone.size(); ++k) {
                const auto &a = alone[k].body, &b = together[k].body;
                same = same && alone[k].rolls == together[k].rolls;
                ++(alone[k].rolls ? rolled : stopped);
                if (!alone[k].rolls) continue;
                same = same && a.centre == b.centre && a.rotation == b.rotation && a.turn == b.turn &&
                       a.motion.velocity == b.motion.velocity && a.motion.spin == b.motion.spin;
            }
        }
        CAPTURE(spec.model, rolled, stopped);
        CHECK(same);
        CHECK(rolled > 100);
        CHECK(stopped > 100);
    }
}

TEST_CASE("after ten minutes of random driving the closed form and ODE agree", "[sim][rolling]") {
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec(), odd_spec()}) {
        Pair pair(spec);
        RandomDriver driver;
        double most = 0;
        int rolled = 0;
        const int steps = static_cast<int>(600 / step);
        for (int i = 0; i < steps; ++i) {
            pair.drive(driver.next());
            rolled += pair.can_roll() ? 1 : 0;
            pair.take_step();
            most = std::max(most, pair.difference());
        }
        const Truth a = pair.own.truth(0), b = pair.ode.truth(0);
        CAPTURE(spec.mass, rolled, most, a.pose.position.x, a.pose.position.y);
        CHECK(std::hypot(a.pose.position.x - b.pose.position.x, a.pose.position.y - b.pose.position.y) < 1e-9);
        CHECK(std::abs(a.pose.heading - b.pose.heading) < 1e-9);
        CHECK(most < 1e-9);
        CHECK(rolled > steps * 9 / 10);
    }
}

TEST_CASE("a robot that switches at random between closed form and ODE takes the same path", "[sim][rolling]") {
    Pair pair(mouse_spec(), 0.01);
    RandomDriver driver;
    std::mt19937_64 random{3};
    for (int i = 0; i < 6000; ++i) {
        pair.own.robot(0).kept_by_ode = random() % 2 == 0;
        pair.drive(driver.next());
        pair.take_step();
    }
    CHECK(pair.difference() < 1e-9);
    CHECK(pair.own.robot(0).angles == pair.ode.robot(0).angles);
}

TEST_CASE("a robot that rolled freely is not seen after its removal", "[sim][rolling]") {
    OdeWorld world({}, {.step = step, .seed = 1}, nullptr);
    const RobotSpec spec = mouse_spec();
    auto body = world.add_robot("it", spec, {}).value();
    body->set_wheel_speeds({0.1, 0.1});
    world.step(50);
    REQUIRE_FALSE(world.robot(0).by_ode);
    const double there = world.robot(0).body.p[0];
    CHECK(there > 0.01);
    body.reset();
    world.step(50);
    CHECK(world.robot(0).body.p[0] == there);
}

TEST_CASE("colliding robots move the same on average over twenty seeds", "[sim][rolling]") {
    // Collisions are chaotic: rounding decides which robots meet a minute later.
    constexpr double seeds = 20;
    const auto compare = [](const char* what, double Bustle::*figure, const std::vector<Bustle>& a,
                            const std::vector<Bustle>& b) {
        const auto mean_of = [&](const std::vector<Bustle>& all) {
            double sum = 0;
            for (const Bustle& each : all) sum += each.*figure;
            return sum / seeds;
        };
        const auto error_of = [&](const std::vector<Bustle>& all) {  // of the mean, squared
            double sum = 0;
            for (const Bustle& each : all) sum += std::pow(each.*figure - mean_of(all), 2);
            return sum / (seeds - 1) / seeds;
        };
        const double apart = mean_of(a) - mean_of(b), error = std::sqrt(error_of(a) + error_of(b));
        CAPTURE(what, mean_of(a), mean_of(b), error);
        CHECK(mean_of(a) > 0.01);
        CHECK(std::abs(apart) < 2.5 * error);
    };
    std::vector<Bustle> rolled, solved;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds); ++seed) {
        rolled.push_back(bustle(seed, false));
        solved.push_back(bustle(seed, true));
    }
    compare("speed", &Bustle::speed, rolled, solved);
    compare("collisions", &Bustle::collisions, rolled, solved);
    compare("spread", &Bustle::spread, rolled, solved);
}

TEST_CASE("robots that are ahead within a tick have the same bits as step by step", "[sim][rolling]") {
    Crowd at_once(60), one_by_one(60);
    std::size_t ahead = 0;
    for (int tick = 0; tick < 300; ++tick) {
        at_once.tick(true);
        one_by_one.tick(false);
        ahead += at_once.bodies.size() - at_once.world.one_by_one();
    }
    CHECK(at_once.is_where(one_by_one));
    CHECK(ahead > 300 * 60 / 4);
}

TEST_CASE("the number of threads changes no bit of freely rolling robots", "[sim][rolling]") {
    WorkerPool two(2), five(5);
    Crowd alone(300), with_two(300, &two), with_five(300, &five);
    for (Crowd* crowd : {&alone, &with_two, &with_five}) {
        for (int tick = 0; tick < 40; ++tick) crowd->tick(true);
    }
    CHECK(alone.is_where(with_two));
    CHECK(alone.is_where(with_five));
}
