// The safety rules for a velocity: what is commanded keeps its arc, what brakes brakes as hard as it can.
#include "engine/robot/velocity_guard.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace nezumi;

namespace {

constexpr Limits limits{.speed = 0.5, .yaw_rate = 6, .acceleration = 2, .yaw_acceleration = 12};
constexpr double dt = 0.01;

// Calls the guard once a period, each with the command.
struct Driven {
    const Velocity2D& drive(const Velocity2D& velocity, int periods = 1) {
        for (int i = 0; i < periods; ++i) {
            now += dt;
            guard.command(velocity, now);
            guard.advance(now, dt);
        }
        return guard.current();
    }
    VelocityGuard guard{limits};
    double now = 0;
};

double length_of(const Velocity2D& v) { return std::hypot(v.vx / limits.speed, v.va / limits.yaw_rate); }

}  // namespace

TEST_CASE("getting up to speed keeps the arc", "[engine][guard][safety]") {
    for (const Velocity2D& target :
         {Velocity2D{.vx = 0.4, .va = 0.5}, {.vx = 0.1, .va = -6}, {.vx = -0.5, .va = 3}, {.vx = 0.3}, {.va = 5}}) {
        Driven it;
        double before = 0;
        int periods = 0;
        while (it.guard.current() != target) {
            const Velocity2D& v = it.drive(target);
            REQUIRE(v.vx * target.va == Approx(v.va * target.vx).margin(1e-12));
            REQUIRE(length_of(v) > before);
            before = length_of(v);
            REQUIRE(++periods <= 100);
        }
        // As fast as the slower of the two allows.
        const double slower =
            std::max(std::abs(target.vx) / limits.acceleration, std::abs(target.va) / limits.yaw_acceleration);
        CHECK(periods == static_cast<int>(std::ceil(slower / dt - 1e-9)));
    }
}

TEST_CASE("a command beyond a limit is the same arc, slower", "[engine][guard][safety]") {
    using Verdict = VelocityGuard::Verdict;
    VelocityGuard guard(limits);
    CHECK(guard.command({.vx = 1.0, .va = 3}, 0) == Verdict::clamped);
    CHECK(guard.target() == Velocity2D{.vx = 0.5, .va = 1.5});
    CHECK(guard.command({.vx = 0.25, .va = -12}, 0) == Verdict::clamped);
    CHECK(guard.target() == Velocity2D{.vx = 0.125, .va = -6});
    CHECK(guard.command({.vx = -1.0, .va = 24}, 0) == Verdict::clamped);
    CHECK(guard.target() == Velocity2D{.vx = -0.25, .va = 6});
    CHECK(guard.command({.vx = 0.5, .va = -6}, 0) == Verdict::taken);
    CHECK(guard.target() == Velocity2D{.vx = 0.5, .va = -6});
    CHECK(guard.command({.vx = 1e308, .va = 1e308}, 0) == Verdict::clamped);
    CHECK(guard.target().vx == Approx(0.5));
    CHECK(guard.target().va == Approx(0.5));
}

TEST_CASE("braking is each axis at its own full deceleration", "[engine][guard][safety]") {
    const auto at_speed = [] {
        Driven it;
        it.drive({.vx = 0.5, .va = 1}, 200);
        return it;
    };
    {
        Driven it = at_speed();
        const Velocity2D& v = it.drive({});
        CHECK(v.vx == Approx(0.48));
        CHECK(v.va == Approx(0.88));
        it.drive({}, 9);
        CHECK(v.vx == Approx(0.3));
        CHECK(v.va == 0);
    }
    {
        Driven it = at_speed();  // a smaller command of the same sign, which is another arc
        const Velocity2D& v = it.drive({.vx = 0.1, .va = 0.9});
        CHECK(v.vx == Approx(0.48));
        CHECK(v.va == 0.9);
    }
    {
        Driven it = at_speed();  // silence
        it.guard.advance(it.now + 0.51, dt);
        CHECK(it.guard.current().vx == Approx(0.48));
        CHECK(it.guard.current().va == Approx(0.88));
        // What has passed without a call counts.
        it.guard.advance(it.now + 0.56, dt, 0.05);
        CHECK(it.guard.current().vx == Approx(0.38));
        CHECK(it.guard.current().va == Approx(0.28));
    }
}

TEST_CASE("an axis that turns back brakes to zero first, and the other does not wait", "[engine][guard][safety]") {
    Driven it;
    it.drive({.vx = 0.1, .va = 0.05}, 100);
    const Velocity2D& v = it.drive({.vx = -0.1, .va = 2});
    CHECK(v.vx == Approx(0.08));
    CHECK(v.va == Approx(0.17));  // with nobody to wait for, at its own acceleration
    it.drive({.vx = -0.1, .va = 2}, 4);
    CHECK(v.vx == Approx(0).margin(1e-12));
    it.drive({.vx = -0.1, .va = 2});
    CHECK(v.vx < 0);
    it.drive({.vx = -0.1, .va = 2}, 100);
    CHECK(v == Velocity2D{.vx = -0.1, .va = 2});
}

TEST_CASE("for any command, the guard stays within the limits and reaches the command", "[engine][guard][safety]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-1.5, 1.5);
    std::uniform_int_distribution<int> periods(1, 40);
    Driven it;
    for (int round = 0; round < 2000; ++round) {
        const Velocity2D command{.vx = round % 5 == 0 ? 0 : part(random) * limits.speed,
                                 .va = round % 7 == 0 ? 0 : part(random) * limits.yaw_rate};
        for (int left = periods(random); left > 0; --left) {
            const Velocity2D before = it.guard.current();
            const Velocity2D now = it.drive(command);
            const Velocity2D target = it.guard.target();
            const auto check = [](double from, double to, double reached, double most, double limit) {
                REQUIRE(std::abs(reached) <= limit);
                REQUIRE(std::abs(reached - from) <= most * (1 + 1e-9));
                REQUIRE(reached >= std::min(from, to));  // never beyond its target
                REQUIRE(reached <= std::max(from, to));
                REQUIRE(from * reached >= 0);  // through zero only from zero
                const bool brakes = from * to < 0 || std::abs(to) < std::abs(from);
                const double end = from * to > 0 ? to : 0;
                if (brakes) REQUIRE((reached == end || std::abs(reached - from) == Approx(most)));
            };
            check(before.vx, target.vx, now.vx, limits.acceleration * dt, limits.speed);
            check(before.va, target.va, now.va, limits.yaw_acceleration * dt, limits.yaw_rate);
        }
        if (round % 100 == 0) CHECK(it.drive(command, 101) == it.guard.target());
    }
}
