// Sensors in a simulated world: a scanner, an inertial sensor.
#include <cmath>

#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("each ray of a scan measures the walls around the robot", "[sim][robot]") {
    RobotSpec spec = mouse_spec();
    SensorSpec scan;
    scan.name = "scan";
    scan.kind = SensorSpec::Kind::scan;
    scan.at = {0, 0, 0.05};
    scan.range = 5;
    scan.cone = 2 * M_PI;
    scan.rays = 8;  // from behind, to the right, ahead, to the left: every 45 degrees
    spec.sensors.push_back(scan);
    ArenaSpec arena;
    arena.size = Point2D{2, 4};
    TryWorld world(arena);
    const RobotId id = world.add(spec, 0.25, 0);
    world.run(0.1);
    const Time now{1, 0.01};
    world.bodies[id]->read_wheels(now, 0.01);
    world.bodies[id]->read_sensors(now, 0.01);
    const auto values = world.bodies[id]->sensor_values(spec.sensors.size() - 1);
    REQUIRE(values.size() == 8);
    CHECK(values[0] == Approx(1.25).margin(0.01));  // behind
    CHECK(values[2] == Approx(2).margin(0.01));     // right
    CHECK(values[4] == Approx(0.75).margin(0.01));  // ahead
    CHECK(values[5] == Approx(0.75 * std::sqrt(2.0)).margin(0.02));
    CHECK(values[6] == Approx(2).margin(0.01));  // left
}

TEST_CASE("an imu measures gravity, acceleration and rotation of the robot", "[sim][robot]") {
    RobotSpec spec = mouse_spec();
    SensorSpec imu;
    imu.name = "imu";
    imu.kind = SensorSpec::Kind::imu;
    spec.sensors.push_back(imu);
    TryWorld world;
    const RobotId id = world.add(spec, 0, 0);
    std::int64_t tick = 0;
    const auto felt = [&] {
        const Time now{++tick, static_cast<double>(tick) * 0.01};
        world.bodies[id]->read_sensors(now, 0.01);
        const auto values = world.bodies[id]->sensor_values(spec.sensors.size() - 1);
        return std::vector<double>(values.begin(), values.end());
    };
    // The mean reading over one second, while the wheels' speeds increase by these [m/s2].
    const auto mean = [&](double left, double right) {
        std::vector<double> sum(6);
        for (int i = 1; i <= 100; ++i) {
            world.bodies[id]->set_wheel_speeds({left * i * 0.01, right * i * 0.01});
            world.run(0.01);
            const auto values = felt();
            for (std::size_t k = 0; k < 6; ++k) sum[k] += values[k] / 100;
        }
        return sum;
    };
    world.run(0.5);
    felt();
    const auto rest = mean(0, 0);
    CHECK(rest[5] == Approx(9.81).margin(0.02));
    CHECK(std::abs(rest[3]) < 0.05);
    const auto faster = mean(0.4, 0.4);
    CHECK(faster[3] == Approx(0.4).margin(0.12));  // it pitches slightly, so gravity is measured too
    CHECK(std::abs(faster[4]) < 0.05);
    world.bodies[id]->set_wheel_speeds({});
    world.run(1);
    world.bodies[id]->set_wheel_speeds({-0.0925 / 2, 0.0925 / 2});  // 1 rad/s to the left
    world.run(1);
    CHECK(felt()[2] == Approx(1).margin(0.05));
}
