// The tables of acts on robots, markers and ports: every field with unit and documentation.
#pragma once

#include <optional>

#include "engine/ports/setting.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

/// The new pose of a robot.
struct RobotPlace {
    double x = 0;        ///< [m]
    double y = 0;        ///< [m]
    double heading = 0;  ///< [rad]
};

template <>
struct Describe<RobotPlace> {
    static constexpr std::string_view name = "pose";
    static constexpr std::string_view doc = "Where a robot is put.";
    static constexpr FieldList fields{
        Setting{"x", &RobotPlace::x, "m", ""},
        Setting{"y", &RobotPlace::y, "m", ""},
        Setting{"heading", &RobotPlace::heading, "rad", "counter-clockwise; 0 is along x"},
    };
};

/// The new pose of a marker; omitted fields do not change.
struct MarkerPlace {
    std::optional<double> x, y, z, heading;
};

template <>
struct Describe<MarkerPlace> {
    static constexpr std::string_view name = "marker_pose";
    static constexpr std::string_view doc = "Where a marker is moved.";
    static constexpr FieldList fields{
        Setting{"x", &MarkerPlace::x, "m", "", {.fallback = "as it is"}},
        Setting{"y", &MarkerPlace::y, "m", "", {.fallback = "as it is"}},
        Setting{"z", &MarkerPlace::z, "m", "height of the marker's centre", {.fallback = "as it is"}},
        Setting{"heading", &MarkerPlace::heading, "rad", "direction that the marker faces", {.fallback = "as it is"}},
    };
};

/// The options of `hold`.
struct HoldOptions {
    bool take = false;
};

template <>
struct Describe<HoldOptions> {
    static constexpr std::string_view name = "hold_options";
    static constexpr std::string_view doc = "Options of a hold.";
    static constexpr FieldList fields{
        Setting{"take", &HoldOptions::take, "", "take the port even if another actor holds it"},
    };
};

template <>
struct Describe<VelocityConstraint> {
    static constexpr std::string_view name = "velocity_constraint";
    static constexpr std::string_view doc = "Velocities that are forced on a robot.";
    static constexpr std::array<std::string_view, 2> kinds{"a component's disturb", "s:disturb"};
    static constexpr unsigned at_once = 1U << 0U, in_scenarios = 1U << 1U;
    static constexpr FieldList fields{
        Setting{"vx", &VelocityConstraint::vx, "m/s", "along the robot's x axis", {.fallback = "free"}},
        Setting{"vy", &VelocityConstraint::vy, "m/s", "along the robot's y axis", {.fallback = "free"}},
        Setting{"va", &VelocityConstraint::va, "rad/s", "yaw rate, counter-clockwise", {.fallback = "free"}},
        Extra{"seconds", "number", "s", "how long", {.of = in_scenarios, .fallback = "until `s:restore`"}},
    };
};

}  // namespace nezumi
