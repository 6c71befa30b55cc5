// Worlds and robots for the tests of sim/.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "sim/simulated_body.hpp"
#include "sim/world.hpp"

namespace nezumi::sim {

/// The Raspberry Pi Mouse, with the properties that matter for physics.
inline RobotSpec mouse_spec() {
    RobotSpec spec;
    spec.model = "mouse";
    spec.mass = 0.72;
    spec.body = {BodySpec::Shape::box, {0.10, 0.08, 0.06}, {0, 0, 0.04}};
    spec.drive.radius = 0.024;
    spec.drive.track = 0.0925;
    spec.drive.skid = 0.04;
    const auto ray = [&](const char* name, double x, double y, double yaw) {
        SensorSpec sensor;
        sensor.name = name;
        sensor.at = {x, y, 0.04};
        sensor.yaw = yaw;
        sensor.range = 0.6;
        spec.sensors.push_back(sensor);
    };
    ray("right_front", 0.035, -0.040, 0);
    ray("right_side", 0.045, -0.030, -M_PI / 4);
    ray("left_side", 0.045, 0.030, M_PI / 4);
    ray("left_front", 0.035, 0.040, 0);
    return spec;
}

/// The robot of the swarm workload: a disc with 24 rays.
inline RobotSpec swarm_spec() {
    RobotSpec spec;
    spec.model = "disc";
    spec.mass = 1.6;
    spec.body = {BodySpec::Shape::cylinder, {0.17, 0.17, 0.06}, {0, 0, 0.04}};
    spec.drive.radius = 0.03;
    spec.drive.track = 0.14;
    spec.drive.skid = 0.07;
    for (int i = 0; i < 24; ++i) {
        SensorSpec sensor;
        sensor.name = "ray" + std::to_string(i);
        sensor.yaw = (7.5 + 15 * i) * M_PI / 180;
        sensor.at = {0.085 * std::cos(sensor.yaw), 0.085 * std::sin(sensor.yaw), 0.06};
        sensor.range = 0.1;
        spec.sensors.push_back(sensor);
    }
    return spec;
}

/// A world and its robots, stepped in seconds.
struct TryWorld {
    explicit TryWorld(const ArenaSpec& arena = {}, double physics_step = 0.005, std::uint64_t seed = 1)
        : step(physics_step) {
        auto made = make_world(arena, {.step = physics_step, .seed = seed},
                               [kept = warnings.get()](const std::string& text) { kept->push_back(text); });
        REQUIRE(made);
        world = std::move(*made);
    }

    /// Adds a robot; keeps its description.
    RobotId add(const RobotSpec& spec, double x, double y, double heading = 0, std::string name = "") {
        specs.push_back(std::make_unique<RobotSpec>(spec));
        return add_kept(*specs.back(), x, y, heading, std::move(name));
    }

    /// Adds a robot whose description outlives this object.
    RobotId add_kept(const RobotSpec& spec, double x, double y, double heading = 0, std::string name = "") {
        if (name.empty()) name = "robot" + std::to_string(bodies.size());
        auto body = world->add_robot(name, spec, {{x, y}, heading});
        INFO((body ? "" : body.error().message));
        REQUIRE(body);
        bodies.emplace_back(static_cast<SimulatedBody*>(body->release()));
        return bodies.size() - 1;
    }

    void run(double seconds) { world->step(static_cast<int>(std::lround(seconds / step))); }

    /// Drives every robot at these wheel speeds, calling `look` after every step.
    template <class Look>
    void run(double seconds, Look&& look) {
        for (int i = 0; i < static_cast<int>(std::lround(seconds / step)); ++i) {
            world->step(1);
            look();
        }
    }

    /// Accelerates evenly to these wheel speeds within `seconds`.
    void ramp(RobotId id, Wheels to, double seconds) {
        const int steps = static_cast<int>(std::lround(seconds / step));
        for (int i = 1; i <= steps; ++i) {
            const double part = static_cast<double>(i) / steps;
            bodies[id]->set_wheel_speeds({to.left * part, to.right * part});
            world->step(1);
        }
    }

    Truth truth(RobotId id = 0) const { return world->truth(id); }

    /// The whole state of all robots.
    std::vector<double> bits() const {
        std::vector<double> all;
        for (RobotId i = 0; i < bodies.size(); ++i) {
            const Truth t = world->truth(i);
            const Wheels w = bodies[i]->wheel_angles();
            all.insert(all.end(), {t.pose.position.x, t.pose.position.y, t.pose.heading, t.velocity.vx, t.velocity.vy,
                                   t.velocity.va, t.height, t.tilt, w.left, w.right});
        }
        return all;
    }

    double step;
    std::unique_ptr<std::vector<std::string>> warnings = std::make_unique<std::vector<std::string>>();
    std::vector<std::unique_ptr<RobotSpec>> specs;
    std::unique_ptr<World> world;
    std::vector<std::unique_ptr<SimulatedBody>> bodies;  // destroyed before their world
};

}  // namespace nezumi::sim
