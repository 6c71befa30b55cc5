// A robot's safety: what may reach its wheels, and what silence means.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "engine/trace/channel.hpp"
#include "engine/tree/node.hpp"
#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

using Names = std::vector<std::string>;

double speed_of(FakeRun& run) { return (run.hull().speeds.left + run.hull().speeds.right) / 2; }
double turn_of(FakeRun& run) { return (run.hull().speeds.right - run.hull().speeds.left) / run.spec.drive.track; }

// Drives straight at 0.1 m/s, at speed.
FakeRun& at_speed(FakeRun& run) {
    for (int i = 0; i < 10; ++i) run.send("velocity_in", Velocity2D{.vx = 0.1});
    return run;
}

}  // namespace

TEST_CASE("a command reaches the wheels within the robot's acceleration", "[engine][robot][safety]") {
    FakeRun run;
    run.send("velocity_in", Velocity2D{.vx = 0.1, .va = 1});
    CHECK(turn_of(run) == Approx(0.12));    // 12 rad/s2 for 0.01 s
    CHECK(speed_of(run) == Approx(0.012));  // the same part of its target
    run.ticks(3);
    CHECK(speed_of(run) == Approx(0.048));
    run.ticks(10);
    CHECK(speed_of(run) == Approx(0.1));
    CHECK(turn_of(run) == Approx(1.0));
    run.send("velocity_in", Velocity2D{});
    CHECK(speed_of(run) == Approx(0.08));  // braking too
}

TEST_CASE("a command above the limits is clamped, logged once and shown on the port", "[engine][robot][safety]") {
    FakeRun run;
    CHECK(run.robot->find_in_port("velocity_in")->note().empty());
    for (int i = 0; i < 100; ++i) run.send("velocity_in", Velocity2D{.vx = -1.5, .va = 9});
    CHECK(speed_of(run) == Approx(-0.5));
    CHECK(turn_of(run) == Approx(3));  // the same arc
    CHECK(run.log == Names{"mouse: input 'velocity_in': a command of -1.5 m/s and 9 rad/s was limited to 0.5 m/s and 6 "
                           "rad/s (reported once)"});
    CHECK(run.robot->find_in_port("velocity_in")->note() == "limited to 0.5 m/s and 6 rad/s");
}

TEST_CASE("a command that is not finite stops the robot and is logged once", "[engine][robot][safety]") {
    for (const Velocity2D& bad : {Velocity2D{.vx = std::nan("")}, Velocity2D{.vy = std::nan("")},
                                  Velocity2D{.va = std::numeric_limits<double>::infinity()}}) {
        FakeRun run;
        at_speed(run);
        for (int i = 0; i < 20; ++i) run.send("velocity_in", bad);
        CHECK(run.hull().speeds == Wheels{});
        CHECK(run.log ==
              Names{"mouse: input 'velocity_in': a command that is not finite stops the robot (reported once)"});
        for (const Wheels& speeds : run.hull().all_speeds) {
            CHECK(std::isfinite(speeds.left));
            CHECK(std::isfinite(speeds.right));
        }
    }
}

TEST_CASE("two wheels don't drive sideways, which is reported once", "[engine][robot][safety]") {
    FakeRun run;
    for (int i = 0; i < 10; ++i) run.send("velocity_in", Velocity2D{.vx = 0.1, .vy = 0.2});
    CHECK(speed_of(run) == Approx(0.1));
    CHECK(run.log.size() == 1);
}

TEST_CASE("a robot stops when its velocity in-port got nothing for 0.5 s", "[engine][robot][safety][fault]") {
    for (const double rate : {20.0, 100.0, 200.0}) {
        FakeRun run(fake_mouse(), rate);
        for (int i = 0; i < static_cast<int>(rate); ++i) run.send("velocity_in", Velocity2D{.vx = 0.1});
        const double last = run.system.now().seconds - 1 / rate;  // when the last command arrived
        while (run.system.now().seconds < last + 0.5 - 1e-9) {
            run.system.tick();
            REQUIRE(speed_of(run) == Approx(0.1));
        }
        run.system.tick();
        CHECK(speed_of(run) < 0.1);
        run.ticks(static_cast<int>(rate));
        CHECK(run.hull().speeds == Wheels{});
        run.send("velocity_in", Velocity2D{.vx = 0.1});
        CHECK(speed_of(run) > 0);
    }
}

TEST_CASE("a robot stops when the component that drives it is disconnected or removed", "[engine][robot][safety]") {
    for (const bool removed : {false, true}) {
        FakeRun run;
        auto made = std::make_unique<TryComponent>("driver");
        made->executed = [](TryComponent& self) -> Expected<void> {
            self.speed.write({.vx = 0.1});
            return {};
        };
        REQUIRE((*run.system.add(std::move(made)))->activate(run.system.now()));
        REQUIRE(run.system.connect("driver.speed", "mouse.velocity_in"));
        run.ticks(20);
        CHECK(speed_of(run) == Approx(0.1));
        if (removed) {
            REQUIRE(run.system.remove("driver"));
        } else {
            REQUIRE(run.system.disconnect("driver.speed", "mouse.velocity_in"));
        }
        run.system.tick();
        CHECK(speed_of(run) == Approx(0.08));
        run.ticks(10);
        CHECK(run.hull().speeds == Wheels{});
    }
}

TEST_CASE("a robot that is connected to another component stops when its driver is disconnected",
          "[engine][robot][safety]") {
    FakeRun run;
    auto driver = std::make_unique<TryComponent>("driver");
    driver->executed = [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.1});
        return {};
    };
    REQUIRE((*run.system.add(std::move(driver)))->activate(run.system.now()));
    REQUIRE(run.system.add(std::make_unique<TryComponent>("silent")));
    REQUIRE(run.system.connect("driver.speed", "mouse.velocity_in"));
    run.ticks(20);
    REQUIRE(run.system.disconnect("driver.speed", "mouse.velocity_in"));
    REQUIRE(run.system.connect("silent.speed", "mouse.velocity_in"));
    run.ticks(20);
    CHECK(run.hull().speeds == Wheels{});
}

TEST_CASE("a robot that is not ACTIVE stops, and is silent to its commands", "[engine][robot][safety]") {
    FakeRun run;
    at_speed(run);
    run.send("buzzer_in", std::int16_t{440});
    REQUIRE(run.robot->deactivate(run.system.now()));
    for (int i = 0; i < 10; ++i) run.send("velocity_in", Velocity2D{.vx = 0.1});
    CHECK(run.hull().speeds == Wheels{});
    CHECK(run.hull().hertz == 0);
    const double before = run.robot->find_out_port("velocity")->tm();
    run.ticks(3);
    CHECK(run.robot->find_out_port("velocity")->tm() == before);
}

TEST_CASE("a robot that is activated while it rolls keeps to its acceleration", "[engine][robot][safety]") {
    FakeRun run;
    at_speed(run);
    REQUIRE(run.robot->deactivate(run.system.now()));
    REQUIRE(run.robot->activate(run.system.now()));
    run.system.tick();
    CHECK(speed_of(run) == Approx(0.08));
}

TEST_CASE("the body of a robot that is removed stops", "[engine][robot][safety]") {
    FakeRun run;
    at_speed(run);
    REQUIRE(run.system.remove("mouse"));
    CHECK(run.hull().speeds == Wheels{});
}

namespace {

// A real mouse at 100 ticks per second of a clock that goes as the test says.
struct RealRun {
    explicit RealRun(double rate = 100, RobotSpec its_spec = fake_mouse())
        : spec(std::move(its_spec)),
          system({.rate = rate, .real_time = true, .clock = [this] { return clock; }},
                 [this](const LogLine& line) { log.push_back(line.component + ": " + line.text); }) {
        auto made = Robot::make("mouse", spec, spec.drive.limits);
        REQUIRE(made);
        robot = made->get();
        robot->take_body(std::make_unique<FakeBody>(hull, spec, not_simulated));
        REQUIRE(system.add(std::move(*made)));
        REQUIRE(robot->activate(system.now()));
    }
    // Some time later: a tick, with a command.
    void drive(double passed, double speed = 0.1) {
        clock += passed;
        robot->find_in_port("velocity_in")->inject(Velocity2D{.vx = speed});
        system.tick();
    }

    RobotSpec spec;
    FakeHull hull;
    double clock = 50;
    Names log;
    System system;
    Robot* robot = nullptr;
};

}  // namespace

TEST_CASE("a stalled loop is a stop, from which the next command starts", "[engine][robot][safety][hardware]") {
    RealRun run;
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.1));
    run.drive(0.19);  // late, but no stall
    CHECK(run.hull.speeds.left == Approx(0.1));
    run.drive(0.21);
    CHECK(run.hull.speeds == Wheels{});
    CHECK(run.log == Names{"mouse: stops: no tick was computed for 0.21 s"});
    run.drive(0.01);  // no faster than ever
    CHECK(run.hull.speeds.left == Approx(0.02));
    run.drive(2);
    CHECK(run.hull.speeds == Wheels{});
    // With slow ticks three of them.
    RealRun slow(10);
    for (int i = 0; i < 20; ++i) slow.drive(0.1);
    slow.drive(0.29);
    CHECK(slow.hull.speeds.left == Approx(0.1));
    slow.drive(0.31);
    CHECK(slow.hull.speeds == Wheels{});
}

TEST_CASE("a real robot stands at once when the script that drives it has hung, and brakes after any other error",
          "[engine][robot][safety][hardware]") {
    const auto speed_after = [](Error::Kind kind) {
        RealRun run;
        auto made = std::make_unique<TryComponent>("driver");
        TryComponent& driver = *made;
        driver.executed = [](TryComponent& self) -> Expected<void> {
            self.speed.write({.vx = 0.1});
            return {};
        };
        REQUIRE(run.system.add(std::move(made)));
        REQUIRE(run.system.connect("driver.speed", "mouse.velocity_in"));
        REQUIRE(driver.activate(run.system.now()));
        const auto ticks = [&](int count) {
            for (int i = 0; i < count; ++i) {
                run.clock += 0.01;
                run.system.tick();
            }
        };
        ticks(20);
        CHECK(run.hull.speeds.left == Approx(0.1));
        driver.executed = [kind](TryComponent&) -> Expected<void> { return Unexpected(Error{"no more", {}, kind}); };
        ticks(1);
        CHECK(driver.state() == LifeState::error);
        const double speed = run.hull.speeds.left;
        // What drives it next finds it as ever.
        run.drive(0.01);
        CHECK(run.hull.speeds.left == Approx(speed == 0 ? 0.02 : 0.1));
        return speed;
    };
    CHECK(speed_after(Error::Kind::ordinary) == Approx(0.08));
    CHECK(speed_after(Error::Kind::out_of_time) == 0);

    FakeRun simulated;
    at_speed(simulated).robot->halt();
    simulated.system.tick();
    CHECK(speed_of(simulated) == Approx(0.1));
}

TEST_CASE("a robot speeds up by no more than a period gives, and brakes for all that has passed",
          "[engine][robot][safety][hardware]") {
    RealRun run;
    run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.02));
    run.drive(0.1);
    CHECK(run.hull.speeds.left == Approx(0.04));
    for (int i = 0; i < 20; ++i) run.drive(0.01, 0.3);
    run.drive(0.03, 0);
    CHECK(run.hull.speeds.left == Approx(0.3 - 3 * 0.02));
}

TEST_CASE("a real robot's commands time out by the clock", "[engine][robot][safety][hardware]") {
    RealRun run;
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    for (int i = 0; i < 4; ++i) {
        run.clock += 0.12;  // four ticks in 0.48 s
        run.system.tick();
        CHECK(run.hull.speeds.left == Approx(0.1));
    }
    run.clock += 0.02;
    run.system.tick();
    CHECK(run.hull.speeds.left < 0.1);
}

TEST_CASE("a robot stands while a sensor that it needs is silent", "[engine][robot][safety][hardware]") {
    RobotSpec spec = fake_mouse();
    REQUIRE_FALSE(spec.sensors.empty());
    spec.drive.needs = {spec.sensors[0].name};
    RealRun run(100, spec);
    run.hull.readings[0] = {.is_there = false};
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds == Wheels{});  // it has not said anything yet
    CHECK(run.log.empty());
    run.hull.readings.clear();
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.1));
    run.hull.readings[0] = {.is_there = false};
    for (int i = 0; i < 28; ++i) run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.1));
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds == Wheels{});
    const std::string name = spec.sensors[0].name;
    CHECK(run.log == Names{"mouse: stands: it needs readings of " + name + " to drive, and gets none from it"});
    run.hull.readings.clear();
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.1));
    CHECK(run.log.back() == "mouse: gets readings again from " + name);
    // A reading that is always the same old one is none.
    run.hull.measured_late = 0.3;
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds == Wheels{});
}

TEST_CASE("a robot brakes while its supply voltage is low, and drives again afterwards",
          "[engine][robot][safety][hardware]") {
    RealRun run;
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    run.hull.may_drive = false;
    run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.08));
    for (int i = 0; i < 10; ++i) run.drive(0.01);
    CHECK(run.hull.speeds == Wheels{});
    run.hull.may_drive = true;
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    CHECK(run.hull.speeds.left == Approx(0.1));
}

TEST_CASE("a battery has a value in the tree while its body knows of one, NaN while that can't be read",
          "[engine][robot][tree]") {
    FakeRun run;
    const auto volts = [&]() -> Expected<double> {
        const auto value = TreeNode(run.system).find("mouse.battery").value().value();
        if (!value) return Unexpected(value.error());
        return std::get<Value>(*value).get<double>();
    };
    const auto recorded = [&] { return changing_members(*TreeNode(run.system).child("mouse")); };
    CHECK(volts().error().message == "mouse: its battery is known only with a real robot that measures it");
    CHECK(recorded().front() == "buzzer");
    run.hull().battery = 7.4;
    CHECK(volts() == 7.4);
    CHECK(recorded().front() == "battery");
    run.hull().battery = std::nan("");
    CHECK(std::isnan(volts().value()));
}

TEST_CASE("a real robot's motors have power while it is ACTIVE, and until it has braked",
          "[engine][robot][safety][hardware]") {
    RealRun run;
    CHECK(run.hull.power_calls == 0);
    run.drive(0.01);
    CHECK(run.hull.powered);
    CHECK(run.hull.power_calls == 1);
    for (int i = 0; i < 20; ++i) run.drive(0.01);
    REQUIRE(run.robot->deactivate(run.system.now()));
    run.drive(0.01);
    CHECK(run.hull.speeds != Wheels{});
    CHECK(run.hull.powered);
    for (int i = 0; i < 100; ++i) run.drive(0.01);
    CHECK(run.hull.speeds == Wheels{});
    CHECK_FALSE(run.hull.powered);
    run.robot->emergency_stop();
    run.drive(0.01);
    run.robot->rearm();
    run.drive(0.01);
    CHECK_FALSE(run.hull.powered);  // it is not ACTIVE
    REQUIRE(run.robot->activate(run.system.now()));
    run.drive(0.01);
    CHECK(run.hull.powered);
    run.robot->emergency_stop();
    for (int i = 0; i < 100; ++i) run.drive(0.01);
    CHECK_FALSE(run.hull.powered);
    run.robot->rearm();
    CHECK(run.hull.powered);
}

TEST_CASE("wheels that coast roll freely until the first command after activation", "[engine][robot]") {
    RobotSpec spec = fake_mouse();
    spec.drive.coasts_until_commanded = true;
    FakeRun run(spec);
    run.ticks(100);
    CHECK(run.hull().coasting);
    CHECK(run.hull().all_speeds.empty());
    run.send("velocity_in", Velocity2D{});
    CHECK_FALSE(run.hull().coasting);
    run.ticks(100);
    CHECK_FALSE(run.hull().coasting);  // silence holds the wheels, it does not free them
    REQUIRE(run.robot->deactivate(run.system.now()));
    REQUIRE(run.robot->activate(run.system.now()));
    run.system.tick();
    CHECK(run.hull().coasting);
}

TEST_CASE("silence turns off only the actuators that the robot's description names", "[engine][robot][safety]") {
    FakeRun run;
    run.robot->find_in_port("leds_in")->inject(std::vector<bool>{true, false, true, true});
    run.robot->find_in_port("neck_in")->inject(0.5);
    run.send("buzzer_in", std::int16_t{440});
    CHECK(run.hull().hertz == 440);
    run.ticks(49);
    CHECK(run.hull().hertz == 440);
    run.system.tick();
    CHECK(run.hull().hertz == 0);
    run.ticks(100);
    CHECK(run.hull().leds == std::vector<bool>{true, false, true, true});
    CHECK(run.hull().servos[2] == 0.5);

    RobotSpec other = fake_mouse();
    for (PortSpec& port : other.ports) {
        if (port.name == "buzzer_in") port.off_when_silent = false;
        if (port.name == "leds_in") port.off_when_silent = true;
    }
    FakeRun second(other);
    second.robot->find_in_port("leds_in")->inject(std::vector<bool>{true});
    second.send("buzzer_in", std::int16_t{440});
    second.ticks(100);
    CHECK(second.hull().hertz == 440);
    CHECK(second.hull().leds == std::vector<bool>(4, false));
}
