// What a robot publishes: sensors' values, velocity and odometry.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/unit/engine/fake_world.hpp"

using namespace nezumi;

namespace {

constexpr double per_turn = 1e9;

// Of wheels that have turned by these angles [rad].
WheelPulses pulses(double left, double right) {
    return {std::llround(left / (2 * M_PI) * per_turn), std::llround(right / (2 * M_PI) * per_turn)};
}

}  // namespace

TEST_CASE("a port has the readings of its sensors, or the physical quantity that they measure", "[engine][sensor]") {
    FakeRun run;
    run.hull().distances = {0.2, 0.3};
    run.hull().yaw_rate = 0.7;
    run.hull().readings[2] = {.is_there = true, .tm = 0, .value = 1.5, .physical = 0.7};
    run.system.tick();
    CHECK(run.value<std::vector<double>>("ir_metre") == std::vector<double>{0.2, 0.3});
    CHECK(run.value<std::vector<std::int16_t>>("ir") == std::vector<std::int16_t>{300, 300});
    CHECK(run.value<RangeData>("ranger").ranges == std::vector<double>{0.2});
    CHECK(run.value<double>("yaw") == 1.5);
    CHECK(run.value<double>("yaw_rate") == 0.7);
    run.hull().readings[1] = {.is_there = true, .tm = 0, .value = 1e9, .physical = 0.3};
    run.system.tick();
    CHECK(run.value<std::vector<std::int16_t>>("ir") == std::vector<std::int16_t>{32767, 32767});
}

TEST_CASE("a port one of whose sensors is missing is silent, and speaks again when it is back", "[engine][sensor]") {
    FakeRun run;
    run.ticks(3);
    run.hull().readings[1] = {.is_there = false, .tm = 0, .value = 5, .physical = 5};
    run.ticks(3);
    CHECK(run.robot->find_out_port("ir")->count() == 3);
    CHECK(run.robot->find_out_port("ir_metre")->count() == 3);  // one of its two is there
    CHECK(run.robot->find_out_port("ranger")->count() == 6);
    CHECK(run.robot->find_out_port("velocity")->count() == 6);
    run.hull().readings.clear();
    run.hull().has_encoders = false;
    run.hull().angles = {10, 10};
    run.ticks(3);
    CHECK(run.robot->find_out_port("ir")->count() == 6);
    CHECK(run.robot->find_out_port("velocity")->count() == 6);
    CHECK(run.robot->find_out_port("pose")->count() == 6);
    run.hull().has_encoders = true;
    run.system.tick();
    CHECK(run.value<Pose2D>("pose").position.x == Approx(0.2));  // what was turned meanwhile counts
}

TEST_CASE("a message carries the time at which its oldest sensor was read", "[engine][sensor]") {
    FakeRun run;
    run.ticks(10);
    CHECK(run.robot->find_out_port("ir")->tm() == Approx(0.09));
    run.hull().measured_late = 0.004;
    run.hull().readings[1] = {.is_there = true, .tm = 0.02, .value = 5, .physical = 5};
    run.system.tick();
    CHECK(run.robot->find_out_port("yaw")->tm() == Approx(0.096));
    CHECK(run.robot->find_out_port("pose")->tm() == Approx(0.096));
    CHECK(run.robot->find_out_port("ir_metre")->tm() == 0.02);
}

TEST_CASE("each fault that a body reports is logged, and its other devices go on", "[engine][sensor]") {
    FakeRun run;
    const std::vector<std::string> told{"light sensors: no answer", "light sensors: back again",
                                        "light sensors: no answer"};
    for (const std::string& fault : told) {
        run.hull().faults = {fault};
        run.system.tick();
    }
    std::vector<std::string> expected;
    for (const std::string& fault : told) expected.push_back("mouse: " + fault);
    CHECK(run.log == expected);
    CHECK(run.robot->state() == LifeState::active);
    CHECK(run.robot->find_out_port("ir")->count() == 3);
}

TEST_CASE("the distances of several sensors come with their angles", "[engine][sensor]") {
    const auto made = [](std::vector<double> degrees) {
        RobotSpec spec = fake_mouse();
        PortSpec port;
        port.name = "scan";
        port.type = "RangeData";
        for (const double each : degrees) {
            SensorSpec ray = spec.sensors[0];
            ray.name = "ray" + std::to_string(port.items.size());
            ray.yaw = each * M_PI / 180;
            ray.at = {0.1 * std::cos(ray.yaw), 0.1 * std::sin(ray.yaw), 0.05};
            port.items.push_back(ray.name);
            spec.sensors.push_back(ray);
        }
        spec.ports.push_back(port);
        return spec;
    };
    FakeRun run(made({-45, 0, 45}));
    run.hull().distances = {0.6, 0.6, 0.1, 0.2, 0.3};
    run.system.tick();
    const auto scan = run.value<RangeData>("scan");
    CHECK(scan.ranges == std::vector<double>{0.1, 0.2, 0.3});
    CHECK(scan.config.minAngle == Approx(-M_PI / 4));
    CHECK(scan.config.maxAngle == Approx(M_PI / 4));
    CHECK(scan.config.angularRes == Approx(M_PI / 4));
    CHECK(scan.geometry.pose.position.x == Approx(0.1 * (1 + std::sqrt(2)) / 3));
    CHECK(scan.geometry.pose.position.y == Approx(0).margin(1e-12));
    CHECK(scan.geometry.pose.orientation.y == 0);
    // All around, beginning behind.
    FakeRun ring(made({-90, 0, 90, 180}));
    ring.system.tick();
    CHECK(ring.value<RangeData>("scan").config.maxAngle == Approx(M_PI));
    const auto refusal = [&](std::vector<double> degrees) {
        const RobotSpec spec = made(std::move(degrees));
        const auto robot = Robot::make("m", spec, {});
        return robot ? "none" : robot.error().message;
    };
    const std::string start =
        "port 'scan': a RangeData gives its angles as the first, the last and a constant step from right "
        "to "
        "left: the yaw of ";
    CHECK(refusal({-45, 0, 30}) == start + "'ray2' does not fit");
    CHECK(refusal({45, 0, -45}) == start + "'ray1' does not fit");
    CHECK(refusal({10, 10}) == start + "'ray1' does not fit");
}

TEST_CASE("the port of buttons shows pressed buttons", "[engine][sensor]") {
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
          std::vector<std::string>{"mouse: input 'pose_in': a pose that is not finite is ignored (reported once)"});
}

TEST_CASE("odometry adds up arcs", "[engine][odometry]") {
    Odometry odometry(0.024, 0.024, 0.0925, per_turn);
    odometry.update(pulses(7, 9));
    CHECK(odometry.pose() == Pose2D{});
    // A quarter turn to the left about a point 0.5 m to the left.
    const double left = (0.5 - 0.0925 / 2) * std::numbers::pi / 2, right = (0.5 + 0.0925 / 2) * std::numbers::pi / 2;
    odometry.update(pulses(7 + left / 0.024, 9 + right / 0.024));
    CHECK(odometry.pose().position.x == Approx(0.5));
    CHECK(odometry.pose().position.y == Approx(0.5));
    CHECK(odometry.pose().heading == Approx(std::numbers::pi / 2));
    // Straight on, now along y.
    odometry.update(pulses(7 + left / 0.024 + 10, 9 + right / 0.024 + 10));
    CHECK(odometry.pose().position.x == Approx(0.5));
    CHECK(odometry.pose().position.y == Approx(0.74));
    // And on, after an eighth of a turn on the spot.
    const double eighth = 0.0925 / 2 * std::numbers::pi / 4 / 0.024;
    const double ahead = std::sqrt(0.02) / 0.024;
    odometry.update(pulses(7 + left / 0.024 + 10 - eighth, 9 + right / 0.024 + 10 + eighth));
    odometry.update(pulses(7 + left / 0.024 + 10 - eighth + ahead, 9 + right / 0.024 + 10 + eighth + ahead));
    CHECK(odometry.pose().position.x == Approx(0.4));
    CHECK(odometry.pose().position.y == Approx(0.84));
    // A turn so small that the arc's formula would divide by next to nothing.
    Odometry straight(1, 1, 1, 2 * M_PI * 1e9);  // a pulse is a nanometre
    straight.update({0, 0});
    straight.update({1'000'000'000, 1'000'000'001});
    CHECK(straight.pose().position.x == Approx(1));
    CHECK(straight.pose().heading == Approx(1e-9));
}

TEST_CASE("odometry has a diameter for each wheel", "[engine][odometry]") {
    const DriveSpec drive{.radius = 1, .left_radius = 0.02, .right_radius = 0.03, .track = 0.1};
    Odometry odometry(drive.radius_of_left(), drive.radius_of_right(), drive.track, per_turn);
    odometry.update({0, 0});
    odometry.update(pulses(3, 2));
    CHECK(odometry.pose().position.x == Approx(0.06));
    CHECK(odometry.pose().heading == Approx(0).margin(1e-6));
}

TEST_CASE("a pulse is as long after a thousand kilometres as it was at the start", "[engine][odometry]") {
    const double pulse = M_PI * 0.048 / 400;
    for (const std::int64_t before : {std::int64_t{0}, std::int64_t{1} << 33, std::int64_t{1} << 55}) {
        Odometry odometry(0.024, 0.024, 0.0925, 400);
        odometry.update({before, -before});
        odometry.update({before + 1, -before + 1});
        CHECK(odometry.pose().position.x == Approx(pulse).epsilon(1e-12));
        CHECK(odometry.pose().heading == 0);
        for (int i = 2; i <= 400; ++i) odometry.update({before + i, -before + i});
        CHECK(odometry.pose().position.x == Approx(M_PI * 0.048));  // one turn, pi times the diameter
    }
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

TEST_CASE("a scan is a RangeData with the angles of its rays", "[engine][sensor]") {
    RobotSpec spec = fake_mouse();
    SensorSpec scan;
    scan.name = "scan";
    scan.kind = SensorSpec::Kind::scan;
    scan.at = {0.1, 0.0, 0.2};
    scan.yaw = 0.5;
    scan.range = 4;
    scan.minimum = 0.1;
    scan.cone = M_PI;
    scan.rays = 5;
    spec.sensors.push_back(scan);
    PortSpec port;
    port.name = "scan";
    port.type = "RangeData";
    port.items = {"scan"};
    spec.ports.push_back(port);
    port.name = "distances";
    port.type = "TimedFloatSeq";
    spec.ports.push_back(port);
    FakeRun run(spec);
    const std::vector<double> seen{1, 2, 3, 4, 0.5};
    run.hull().values[spec.sensors.size() - 1] = seen;
    run.system.tick();
    const auto range = run.value<RangeData>("scan");
    CHECK(range.ranges == seen);
    CHECK(range.config.minAngle == Approx(-M_PI / 2));
    CHECK(range.config.maxAngle == Approx(M_PI / 2));
    CHECK(range.config.angularRes == Approx(M_PI / 4));
    CHECK(range.config.minRange == 0.1);
    CHECK(range.config.maxRange == 4);
    CHECK(range.geometry.pose.position == Point3D{0.1, 0.0, 0.2});
    CHECK(range.geometry.pose.orientation.y == 0.5);
    CHECK(run.value<std::vector<float>>("distances") == std::vector<float>{1, 2, 3, 4, 0.5});
}

TEST_CASE("an imu's three rates and three accelerations go out together or apart", "[engine][sensor]") {
    RobotSpec spec = fake_mouse();
    SensorSpec imu;
    imu.name = "imu";
    imu.kind = SensorSpec::Kind::imu;
    spec.sensors.push_back(imu);
    PortSpec port;
    port.type = "TimedDoubleSeq";
    port.items = {"imu"};
    for (const auto& [name, quantity] : {std::pair("both", PortSpec::Quantity::value),
                                         {"rates", PortSpec::Quantity::rate},
                                         {"accelerations", PortSpec::Quantity::acceleration}}) {
        port.name = name;
        port.quantity = quantity;
        spec.ports.push_back(port);
    }
    FakeRun run(spec);
    const std::vector<double> felt{1, 2, 3, 4, 5, 9.81};
    run.hull().values[spec.sensors.size() - 1] = felt;
    run.system.tick();
    CHECK(run.value<std::vector<double>>("both") == felt);
    CHECK(run.value<std::vector<double>>("rates") == std::vector<double>{1, 2, 3});
    CHECK(run.value<std::vector<double>>("accelerations") == std::vector<double>{4, 5, 9.81});
}
