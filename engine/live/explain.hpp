// Explains one execution of a component: its inputs, the executed lines, its outputs, and what robots did with them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/components/inside.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

struct Explanation {
    struct PortValue {
        std::string port;                  ///< "controller.in"
        std::string value;                 ///< "" when nothing came yet
        std::vector<std::string> peers{};  ///< the ports that this port is connected to
        std::string override{};            ///< "held", "dropped", "frozen", or ""
    };
    /// A robot that is connected to the component.
    struct OfRobot {
        std::string robot;
        Velocity2D asked;          ///< the commanded velocity
        Velocity2D limited;        ///< the command within the limits of speed and acceleration
        double speed = 0;          ///< [m/s] the robot's speed limit
        double yaw_rate = 0;       ///< [rad/s] the robot's limit of the yaw rate
        bool wheels_told = false;  ///< false: the wheels roll freely
        Wheels wheels{};           ///< [m/s] the commands of its wheels
    };

    std::string component;
    std::int64_t tick = 0;
    double seconds = 0;
    std::vector<PortValue> inputs{}, outputs{};
    TracedLines traced{};
    std::vector<OfRobot> robots{};
};

/// Explains the last traced execution. The values of ports are the present ones, so call it before the next tick.
Explanation explain(const System& system, const Component& component);

/// The text for people, outputs first: "controller.out -> mouse.target_velocity_in: ...", "controller.in <- ...",
/// "counter.lua:9  local near = 3  near = 31", ...
std::string to_text(const Explanation& explanation);

}  // namespace nezumi
