// How time passes for a system: in ticks, by a clock, at rest.
#include <catch2/catch.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "engine/system/system.hpp"
#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

TEST_CASE("time is a tick's number, and a world advances by whole steps", "[engine][system]") {
    System system({.rate = 20, .physics_step = 0.005}, nullptr);
    auto made = std::make_unique<FakeWorld>();
    const FakeWorld& world = *made;
    system.take_world(std::move(made));
    for (int i = 0; i < 30; ++i) system.tick();
    CHECK(system.now().tick == 30);
    CHECK(system.now().seconds == 1.5);
    CHECK(world.steps == 300);
}

TEST_CASE("in real time a tick has the time of the clock", "[engine][system][hardware]") {
    double clock = 1000;
    std::vector<std::pair<double, double>> executed;  // now, dt
    System system({.rate = 100, .real_time = true, .clock = [&clock] { return clock; }}, nullptr);
    auto made = std::make_unique<TryComponent>("it");
    made->executed = [&](TryComponent& self) -> Expected<void> {
        executed.emplace_back(self.now().seconds, self.dt());
        return {};
    };
    REQUIRE((*system.add(std::move(made)))->activate(system.now()));
    for (const double passed : {0.0, 0.01, 0.013, 2.0, 0.01}) {
        clock += passed;
        system.tick();
    }
    REQUIRE(executed.size() == 5);
    const std::vector<std::pair<double, double>> expected{
        {0, 0.01}, {0.01, 0.01}, {0.023, 0.013}, {2.023, 2}, {2.033, 0.01}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(executed[i].first == Approx(expected[i].first).margin(1e-9));
        CHECK(executed[i].second == Approx(expected[i].second));
    }
    CHECK(system.now().tick == 204);  // those that the stall took have passed
    CHECK(system.last_tick().tick == 203);
    CHECK(system.last_tick().seconds == Approx(2.033));
    CHECK(system.find("it")->find_out_port("out")->tm() == 0);
}

TEST_CASE("after a stall, a component with a rate is neither delayed nor executed more often",
          "[engine][system][hardware]") {
    double clock = 1000;
    std::vector<double> executed;
    System system({.rate = 100, .real_time = true, .clock = [&clock] { return clock; }}, nullptr);
    auto made = std::make_unique<TryComponent>("it");
    made->rate = 2;
    made->executed = [&](TryComponent& self) -> Expected<void> {
        executed.push_back(self.now().seconds);
        return {};
    };
    REQUIRE((*system.add(std::move(made)))->activate(system.now()));
    const auto ticks = [&](int count) {
        for (; count > 0; --count) {
            system.tick();
            clock += 0.01;
        }
    };
    ticks(111);  // due at 0, 0.5 and 1
    clock += 1;  // and at 1.5 and 2
    ticks(60);   // and at 2.5
    REQUIRE(executed.size() == 5);
    CHECK(executed[2] == Approx(1));
    CHECK(executed[3] == Approx(2.11));
    CHECK(executed[4] == Approx(2.5));
}

TEST_CASE("at rest behaviours wait, devices go on and robots stand", "[engine][system][hardware]") {
    FakeRun run;
    auto made = std::make_unique<TryComponent>("driver");
    TryComponent& driver = *made;
    driver.executed = [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.1});
        return {};
    };
    REQUIRE((*run.system.add(std::move(made)))->activate(run.system.now()));
    REQUIRE(run.system.connect("driver.speed", "mouse.velocity_in"));
    run.ticks(10);
    CHECK(run.hull().speeds.left == Approx(0.1));
    run.system.set_at_rest(true);
    const auto executions = driver.executions();
    run.robot->find_in_port("velocity_in")->inject(Velocity2D{.vx = 0.3});
    run.system.tick();
    CHECK(run.hull().speeds.left == Approx(0.08));  // braking as ever
    run.robot->find_in_port("velocity_in")->hold(Velocity2D{.vx = 0.3});
    run.ticks(10);
    CHECK(run.hull().speeds == Wheels{});
    CHECK(driver.executions() == executions);
    CHECK(run.robot->find_out_port("ir")->count() == 21);
    run.robot->find_in_port("velocity_in")->release();
    run.system.set_at_rest(false);
    run.ticks(10);
    CHECK(run.hull().speeds.left == Approx(0.1));
}
