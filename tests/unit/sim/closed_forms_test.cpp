// Paths, slides and rays beside the closed forms of mechanics and of the literature.
#include <algorithm>
#include <cmath>

#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("a robot drives the circle of its two wheel speeds", "[sim][closed]") {
    // Kinematics of the differential drive: R = track / 2 * (right + left) / (right - left).
    for (const RobotSpec& spec : {mouse_spec(), swarm_spec()}) {
        for (const Wheels speeds : {Wheels{0.1, 0.2}, Wheels{0.15, 0.2}, Wheels{0.2, 0.05}}) {
            CAPTURE(spec.model, speeds.left, speeds.right);
            TryWorld w;
            w.add(spec, 0, 0);
            w.ramp(0, speeds, 0.2);
            w.run(0.5);
            const double track = spec.drive.track;
            const double turn = (speeds.right - speeds.left) / track, speed = (speeds.left + speeds.right) / 2;
            const double radius = speed / turn;
            CHECK(w.truth().velocity.va == Approx(turn).epsilon(0.002));
            CHECK(w.truth().velocity.vx == Approx(speed).epsilon(0.002));
            // The centre of the circle lies to the left, at this distance. It does not move.
            const auto centre = [&] {
                const Pose2D pose = w.truth().pose;
                return Point2D{pose.position.x - radius * std::sin(pose.heading),
                               pose.position.y + radius * std::cos(pose.heading)};
            };
            const Point2D before = centre();
            double off = 0;
            w.run(2 * M_PI / std::abs(turn), [&] {
                const Point2D now = centre();
                off = std::max(off, std::hypot(now.x - before.x, now.y - before.y));
            });
            CHECK(off < 0.01 * std::abs(radius));
        }
    }
}

TEST_CASE("wheels of unequal size bend a straight line as Borenstein and Feng say", "[sim][closed]") {
    // J. Borenstein and L. Feng, "Measurement and correction of systematic odometry errors in mobile robots", IEEE
    // Transactions on Robotics and Automation 12 (6), 1996: the path is a circle of radius (b / 2) (DR + DL) / (DR -
    // DL). A straight line of length L ends L^2 / (2 R) aside, and turned by L / R.
    RobotSpec spec = mouse_spec();
    spec.drive.left_radius = 0.024 * 0.99;
    const double track = spec.drive.track;
    const double radius = track / 2 * (0.024 + spec.drive.left_radius) / (0.024 - spec.drive.left_radius);
    TryWorld w;
    w.add(spec, 0, 0);
    // Both wheels turn equally, so that the odometry of equal wheels would give a straight line.
    const double rate = 0.2 / 0.024;
    w.ramp(0, {rate * spec.drive.left_radius, 0.2}, 0.1);
    w.run(9.95);
    const Truth t = w.truth();
    const double length = 0.2 * 0.995 * 10;
    CHECK(t.pose.heading == Approx(length / radius).epsilon(0.02));
    CHECK(t.pose.position.y == Approx(radius * (1 - std::cos(length / radius))).epsilon(0.03));
    CHECK(t.pose.position.x == Approx(radius * std::sin(length / radius)).epsilon(0.01));
}

TEST_CASE("a robot with locked wheels slides as far as Coulomb's law says", "[sim][closed]") {
    // v^2 / (2 a), with a = mu g times the part of the weight that the wheels carry; skids slide without friction.
    constexpr double on_wheels = 0.7;
    for (const double friction : {0.05, 0.1, 0.2}) {
        for (const double speed : {0.3, 0.5, 0.8}) {
            CAPTURE(friction, speed);
            RobotSpec spec = mouse_spec();
            spec.friction = friction;
            TryWorld w;
            w.add(spec, 0, 0);
            w.ramp(0, {speed, speed}, 2 * speed / (on_wheels * friction * 9.81));
            w.run(0.5);
            const double from = w.truth().pose.position.x, at = w.truth().velocity.vx;
            w.bodies[0]->set_wheel_speeds({});
            w.run(5);
            const double expected = at * at / (2 * on_wheels * friction * 9.81);
            CHECK(w.truth().pose.position.x - from == Approx(expected).epsilon(0.05));
        }
    }
}

TEST_CASE("the distances of a robot's rays are those of trigonometry", "[sim][closed]") {
    // A wall whose face is x = 1. A ray at an angle a from a sensor at x_s meets it after (1 - x_s) / cos(a).
    ArenaSpec arena;
    arena.boxes.push_back({.at = {1.05, 0, 0.1}, .size = {0.1, 20, 0.2}});
    for (const double heading : {-0.6, -0.3, 0.0, 0.2, 0.5}) {
        CAPTURE(heading);
        RobotSpec spec = mouse_spec();
        for (SensorSpec& sensor : spec.sensors) sensor.range = 8;
        TryWorld w(arena);
        w.add(spec, 0.2, 0.1, heading);
        std::vector<double> distances(spec.sensors.size());
        w.bodies[0]->read_ranges(distances, {});
        for (std::size_t i = 0; i < spec.sensors.size(); ++i) {
            const SensorSpec& sensor = spec.sensors[i];
            const double x = 0.2 + sensor.at.x * std::cos(heading) - sensor.at.y * std::sin(heading);
            CHECK(distances[i] == Approx((1 - x) / std::cos(heading + sensor.yaw)).margin(1e-6));
        }
    }
}
