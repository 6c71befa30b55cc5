// One execution of a component, explained: what came in, the lines that ran, what went out, and what robots made of it.
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
        std::vector<std::string> peers{};  ///< the ports that it is connected to
        std::string override{};            ///< "held", "dropped", "frozen", or ""
    };
    /// A robot that hears it, or that it hears.
    struct OfRobot {
        std::string robot;
        Velocity2D asked;     ///< what it was told
        Velocity2D limited;   ///< what its limits make of that
        double speed = 0;     ///< [m/s] that it may drive at most
        double yaw_rate = 0;  ///< [rad/s] that it may turn at most
        bool wheels_told = false;
        Wheels wheels{};  ///< [m/s] that its wheels are told
    };

    std::string component;
    std::int64_t tick = 0;
    double seconds = 0;
    std::vector<PortValue> inputs{}, outputs{};
    TracedLines traced{};
    std::vector<OfRobot> robots{};
};

/// Of the execution that was traced last; the ports are as they are now, so that it is to be asked for between that
/// tick and the next.
Explanation explain(const System& system, const Component& component);

/// For people, what went out first: "controller.out -> mouse.target_velocity_in: ...", "controller.in <- ...",
/// "counter.lua:9  local near = 3  near = 31", ...
std::string to_text(const Explanation& explanation);

}  // namespace nezumi
