// A robot moved by the solvers of this project, and the same robot moved by ODE.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "sim/free_rolling.hpp"
#include "sim/ode_world.hpp"
#include "tests/unit/sim/try_world.hpp"

namespace nezumi::sim {

inline constexpr double step = 0.005;  // [s]

/// Long, tall, heavy before its axle, with wheels of two sizes.
inline RobotSpec odd_spec() {
    RobotSpec spec = mouse_spec();
    spec.mass = 3;
    spec.body = {BodySpec::Shape::box, {0.3, 0.12, 0.3}, {0.02, 0.005, 0.17}};
    spec.drive.track = 0.16;
    spec.drive.skid = 0.12;
    spec.drive.left_radius = 0.0245;
    return spec;
}

/// Each robot is in its own world.
struct Pair {
    explicit Pair(RobotSpec robot, double its_step = step, const ArenaSpec& arena = {}, const Pose2D& at = {})
        : spec(std::move(robot)),
          length(its_step),
          own(arena, {.step = length, .seed = 1}, nullptr),
          ode(arena, {.step = length, .seed = 1}, nullptr) {
        bodies.push_back(own.add_robot("it", spec, at).value());
        bodies.push_back(ode.add_robot("it", spec, at).value());
        ode.robot(0).kept_by_ode = true;
    }

    void drive(Wheels speeds) {
        for (const auto& body : bodies) body->set_wheel_speeds(speeds);
    }
    /// True if the first robot rolls freely in the next step, provided that it is on the flat floor.
    bool can_roll() {
        const SimRobot& robot = own.robot(0);
        return robot.may_roll() && roll_freely(*robot.model, robot.body.state(), robot.speeds, length);
    }
    void take_step() {
        own.step(1);
        ode.step(1);
    }
    /// The largest difference of places [m], rotations and velocities [m/s, rad/s].
    double difference() {
        const BodyView &a = own.robot(0).body, &b = ode.robot(0).body;
        return std::max({(a.centre() - b.centre()).lpNorm<Eigen::Infinity>(),
                         (a.rotation() - b.rotation()).lpNorm<Eigen::Infinity>(),
                         (a.velocity() - b.velocity()).lpNorm<Eigen::Infinity>(),
                         (a.spin() - b.spin()).lpNorm<Eigen::Infinity>()});
    }

    RobotSpec spec;
    double length;  // [s] of a step
    OdeWorld own, ode;
    std::vector<std::unique_ptr<RobotBody>> bodies;
};

}  // namespace nezumi::sim
