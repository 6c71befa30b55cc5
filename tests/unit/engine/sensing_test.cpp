// What a robot publishes: sensors' values, velocity and odometry.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/unit/engine/fake_world.hpp"

using namespace nezumi;

TEST_CASE("with nothing in sight a value is what its table says and a distance its maximum",
          "[engine][sensor][fault]") {
    FakeRun run;
    run.system.tick();
    CHECK(run.value<std::vector<std::int16_t>>("ir") == std::vector<std::int16_t>{0, 0});  // and not -1978
    CHECK(run.value<std::vector<double>>("ir_metre") == std::vector<double>{0.6, 0.6});
}

TEST_CASE("distances stay within what the sensor can measure", "[engine][sensor]") {
    FakeRun run;
    run.hull().distances = {0.2, 0.3};
    run.system.tick();
    CHECK(run.value<std::vector<double>>("ir_metre") == std::vector<double>{0.2, 0.3});
    CHECK(run.value<std::vector<std::int16_t>>("ir") == std::vector<std::int16_t>{100, 100});
    CHECK(run.value<RangeData>("ranger").ranges == std::vector<double>{0.2});
    run.hull().distances = {0.001, 0.7};
    run.system.tick();
    CHECK(run.value<std::vector<double>>("ir_metre") == std::vector<double>{0.03, 0.6});
    CHECK(run.value<std::vector<std::int16_t>>("ir") == std::vector<std::int16_t>{0, 0});
    run.hull().distances = {0.6, 0.001};
    run.system.tick();
    CHECK(run.value<std::vector<double>>("ir_metre") == std::vector<double>{0.6, 0.03});
    CHECK(run.value<std::vector<std::int16_t>>("ir") == std::vector<std::int16_t>{4095, 4095});
}

TEST_CASE("noise never leaves a sensor's range, averages to nothing and follows the seed", "[engine][sensor]") {
    RobotSpec spec = fake_mouse();
    for (SensorSpec& sensor : spec.sensors) {
        if (sensor.kind == SensorSpec::Kind::range) sensor.noise = sensor.has_response ? 50 : 0.05;
    }
    const auto values = [&](std::uint64_t seed, std::vector<double> distances) {
        FakeRun run(spec, 100, seed);
        run.hull().distances = std::move(distances);
        std::vector<double> all;
        for (int i = 0; i < 2000; ++i) {
            run.system.tick();
            all.push_back(run.value<std::vector<double>>("ir_metre")[0]);
            const std::int16_t light = run.value<std::vector<std::int16_t>>("ir")[0];
            REQUIRE(light >= 0);
            REQUIRE(light <= 4095);
            REQUIRE(all.back() >= 0.03);
            REQUIRE(all.back() <= 0.6);
            all.push_back(light);
        }
        return all;
    };
    const std::vector<double> once = values(7, {0.3, 0.2});
    CHECK(once == values(7, {0.3, 0.2}));
    CHECK(once != values(8, {0.3, 0.2}));
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < once.size(); i += 2) {
        sum += once[i] - 0.3;
        squares += (once[i] - 0.3) * (once[i] - 0.3);
    }
    CHECK(std::abs(sum / 2000) < 0.005);
    CHECK(std::sqrt(squares / 2000) == Approx(0.05).epsilon(0.1));
    values(7, {0.031, 0.001});  // at the edges of both
    values(7, {});
}

TEST_CASE("two robots of one seed have noise of their own", "[engine][sensor]") {
    RobotSpec spec = fake_mouse();
    spec.sensors[0].noise = 0.05;
    FakeHull hull;
    hull.distances = {0.3};
    const FakeBody body(hull);
    const auto value = [&](std::string_view name) {
        SensorValues values(spec, mix(1, name));
        values.read(body, {5, 0.05}, 0.01);
        return values.value(0);
    };
    CHECK(value("left") == value("left"));
    CHECK(value("left") != value("right"));
}

TEST_CASE("a gyro adds up the yaw rate as far as it can follow", "[engine][sensor]") {
    for (const double rate : {100.0, 50.0}) {
        FakeRun run(fake_mouse(), rate);
        run.hull().yaw_rate = 0.5;
        run.ticks(static_cast<int>(rate));
        CHECK(run.value<double>("yaw") == Approx(0.5));
        run.hull().yaw_rate = -9;
        run.ticks(static_cast<int>(rate));
        CHECK(run.value<double>("yaw") == Approx(0.5 - 2));
    }
    RobotSpec drifting = fake_mouse();
    drifting.sensors[2].drift = 0.01;
    FakeRun run(drifting);
    run.ticks(100);
    CHECK(run.value<double>("yaw") == Approx(0.01));
}

TEST_CASE("buttons are told as they are pressed", "[engine][sensor]") {
    FakeRun run;
    run.system.tick();
    CHECK(run.value<std::vector<bool>>("buttons") == std::vector<bool>{false});
    run.world->press(0, 3, true);
    run.system.tick();
    CHECK(run.value<std::vector<bool>>("buttons") == std::vector<bool>{true});
}

TEST_CASE("devices publish at their rate whether or not the value changed", "[engine][sensor]") {
    RobotSpec spec = fake_mouse();
    for (PortSpec& port : spec.ports) {
        if (port.name == "ranger") port.rate = 30;
        if (port.name == "yaw") port.rate = 500;
    }
    FakeRun run(spec);
    run.ticks(100);
    CHECK(run.robot->find_out_port("ir")->count() == 100);
    CHECK(run.robot->find_out_port("ranger")->count() == 30);
    CHECK(run.robot->find_out_port("yaw")->count() == 100);
    CHECK(run.value<RangeData>("ranger").config.frequency == 30);
    FakeRun slow(fake_mouse(), 20);
    slow.system.tick();
    CHECK(slow.value<RangeData>("ranger").config.frequency == 20);
}

TEST_CASE("velocity is measured at the wheels", "[engine][sensor][fault]") {
    FakeRun run;
    run.hull().angles = {5, 5};  // the first look only sets the zero
    run.system.tick();
    CHECK(run.value<Velocity2D>("velocity") == Velocity2D{});
    run.hull().angles = {5.1, 5.2};
    run.system.tick();
    CHECK(run.value<Velocity2D>("velocity").vx == Approx(0.15 * 0.02 * 100));
    CHECK(run.value<Velocity2D>("velocity").vy == 0);
    CHECK(run.value<Velocity2D>("velocity").va == Approx(0.1 * 0.02 / 0.1 * 100));
    run.system.tick();
    CHECK(run.value<Velocity2D>("velocity") == Velocity2D{});
}

TEST_CASE("a pose update sets the odometry, which goes on from there", "[engine][sensor][fault]") {
    FakeRun run;
    run.system.tick();
    run.hull().angles = {10, 10};
    run.system.tick();
    CHECK(run.value<Pose2D>("pose").position.x == Approx(0.2));
    run.send("pose_in", Pose2D{{3, 4}, std::numbers::pi / 2});
    run.hull().angles = {20, 20};
    run.system.tick();
    CHECK(run.value<Pose2D>("pose").position.x == Approx(3));
    CHECK(run.value<Pose2D>("pose").position.y == Approx(4.2));
    CHECK(run.value<Pose2D>("pose").heading == Approx(std::numbers::pi / 2));
    // One that is not finite would be for ever.
    for (int i = 0; i < 2; ++i) run.send("pose_in", Pose2D{{std::nan(""), 0}, 0});
    run.system.tick();
    CHECK(run.value<Pose2D>("pose").position.y == Approx(4.2));
    CHECK(run.log ==
          std::vector<std::string>{"mouse: input 'pose_in': a pose that is not finite is ignored (said once)"});
}

TEST_CASE("odometry adds up arcs as robots.md says", "[engine][odometry]") {
    Odometry odometry(0.024, 0.024, 0.0925, 0);
    odometry.update({7, 9});
    CHECK(odometry.pose() == Pose2D{});
    // A quarter turn to the left about a point 0.5 m to the left.
    const double left = (0.5 - 0.0925 / 2) * std::numbers::pi / 2, right = (0.5 + 0.0925 / 2) * std::numbers::pi / 2;
    odometry.update({7 + left / 0.024, 9 + right / 0.024});
    CHECK(odometry.pose().position.x == Approx(0.5));
    CHECK(odometry.pose().position.y == Approx(0.5));
    CHECK(odometry.pose().heading == Approx(std::numbers::pi / 2));
    // Straight on, now along y.
    odometry.update({7 + left / 0.024 + 10, 9 + right / 0.024 + 10});
    CHECK(odometry.pose().position.x == Approx(0.5));
    CHECK(odometry.pose().position.y == Approx(0.74));
    // A turn so small that the arc's formula would divide by next to nothing.
    Odometry straight(1, 1, 1, 0);
    straight.update({0, 0});
    straight.update({1, 1 + 1e-9});
    CHECK(straight.pose().position.x == Approx(1));
    CHECK(straight.pose().heading == Approx(1e-9));
}

TEST_CASE("odometry has a diameter for each wheel", "[engine][odometry]") {
    Odometry odometry(0.02, 0.03, 0.1, 0);
    odometry.update({0, 0});
    odometry.update({3, 2});
    CHECK(odometry.pose().position.x == Approx(0.06));
    CHECK(odometry.pose().heading == Approx(0).margin(1e-12));
}

TEST_CASE("odometry counts whole pulses, and loses none", "[engine][odometry]") {
    Odometry odometry(0.024, 0.024, 0.0925, 400);
    const double pulse = 2 * std::numbers::pi / 400;
    odometry.update({0, 0});
    odometry.update({0.4 * pulse, 0.4 * pulse});
    CHECK(odometry.pose().position.x == 0);
    odometry.update({0.8 * pulse, 0.8 * pulse});
    CHECK(odometry.pose().position.x == Approx(pulse * 0.024));
    for (int i = 0; i <= 4000; ++i) odometry.update({0.1 * i * pulse, 0.1 * i * pulse});
    CHECK(odometry.pose().position.x == Approx(400 * pulse * 0.024));  // one turn, pi times the diameter
    CHECK(odometry.pose().position.x == Approx(std::numbers::pi * 0.048));
}

TEST_CASE("a guard gives what was commanded, within its limits, until silence", "[engine][guard]") {
    VelocityGuard guard({.speed = 0.5, .yaw_rate = 6, .acceleration = 2, .yaw_acceleration = 12});
    using Verdict = VelocityGuard::Verdict;
    CHECK(guard.command({.vx = 0.5, .va = -6}, 1) == Verdict::taken);
    CHECK(guard.command({.vx = 0.51}, 1) == Verdict::clamped);
    CHECK(guard.command({.va = -6.1}, 1) == Verdict::clamped);
    CHECK(guard.command({.vx = std::nan("")}, 1) == Verdict::not_finite);
    CHECK(guard.target() == Velocity2D{});
    CHECK(guard.command({.vx = 0.1}, 1) == Verdict::taken);
    CHECK(guard.advance(1, 0.01) == Velocity2D{.vx = 0.02});
    CHECK(guard.advance(1.1, 1) == Velocity2D{.vx = 0.1});
    CHECK(guard.advance(1.49, 1) == Velocity2D{.vx = 0.1});
    CHECK(guard.advance(1.5, 1) == Velocity2D{});
    CHECK(guard.advance(9, 1) == Velocity2D{});
}
