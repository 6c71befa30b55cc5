// The words of a system file: every field with unit, documentation and limits.
#pragma once

#include "engine/base/schedule.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/world/arena_fields.hpp"
#include "engine/world/robot_fields.hpp"

namespace nezumi {

template <>
struct Describe<LimitChanges> {
    static constexpr std::string_view name = "limit_changes";
    static constexpr std::string_view doc = "Limits of a robot of the system that differ from its model's.";
    static constexpr auto& fields = limit_fields<LimitChanges>;
};

template <>
struct Describe<RobotEntry> {
    static constexpr std::string_view name = "robot";
    static constexpr std::string_view doc = "A robot of the system.";
    static constexpr FieldList fields{
        Setting{"model", &RobotEntry::model, "", "a robot's file, for example \"raspimouse\"", {.required = true}},
        Setting{"pose", &RobotEntry::pose, "", "start pose"},
        Setting{"limits", &RobotEntry::limits, "", "limits that replace those of the model"},
        Setting{"backend", &RobotEntry::backend, "",
                "\"sim\": simulated even with --hw; or the name of the driver that --hw uses"},
        Setting{"calibrated", &RobotEntry::calibrated, "",
                "use `NAME.calibration.lua` in the folder of this file also in simulation"},
        Setting{"odometry_at_pose", &RobotEntry::odometry_at_pose, "",
                "the odometry starts at `pose`, in the arena's coordinates; otherwise at 0, 0, 0"},
        Setting{"active", &RobotEntry::active, "", "whether the component is activated at the start"},
        Internal{&RobotEntry::name},
        Internal{&RobotEntry::place},
        Internal{&RobotEntry::description},
        Internal{&RobotEntry::changes},
        Internal{&RobotEntry::twin_of},
        Internal{&RobotEntry::driver},
    };
};

template <>
struct Describe<BehaviorEntry> {
    static constexpr std::string_view name = "behavior";
    static constexpr std::string_view doc = "A component written in Lua.";
    static constexpr FieldList fields{
        Setting{"script",
                &BehaviorEntry::script,
                "",
                "a behaviour's file, for example \"robot_controller\"",
                {.required = true}},
        Setting{"config", &BehaviorEntry::config, "", "values of the component's parameters"},
        Setting{"sets", &BehaviorEntry::sets, "",
                "parameter sets: values that are chosen together, by the name of the set"},
        Setting{"set", &BehaviorEntry::set, "",
                "the parameter set in use; omitted parameters have the values of `config`"},
        Setting{"rate",
                &BehaviorEntry::rate,
                "Hz",
                "executions per second, at most the tick rate",
                {.range = NumberRange::positive, .least = slowest_rate, .fallback = "the tick's"}},
        Setting{"active", &BehaviorEntry::active, "", "whether the component is activated at the start"},
        Internal{&BehaviorEntry::name},
        Internal{&BehaviorEntry::path},
        Internal{&BehaviorEntry::place},
        Internal{&BehaviorEntry::places},
    };
};

template <>
struct Describe<ComponentEntry> {
    static constexpr std::string_view name = "component";
    static constexpr std::string_view doc = "A native component.";
    static constexpr FieldList fields{
        Setting{
            "type", &ComponentEntry::type, "", "a native component's type, for example \"Camera\"", {.required = true}},
        Setting{"config", &ComponentEntry::config, "", "values of the component's parameters"},
        Setting{"rate",
                &ComponentEntry::rate,
                "Hz",
                "executions per second, at most the tick rate",
                {.range = NumberRange::positive, .least = slowest_rate, .fallback = "the type's own"}},
        Setting{"on", &ComponentEntry::on, "", "the robot that carries the component"},
        Setting{"at", &ComponentEntry::at, "m",
                "position on that robot, from the middle of the wheels' axis on the floor"},
        Setting{"yaw", &ComponentEntry::yaw, "rad", "direction on that robot, counter-clockwise"},
        Setting{"backend", &ComponentEntry::backend, "", "\"sim\": simulated even with --hw"},
        Setting{"active", &ComponentEntry::active, "", "whether the component is activated at the start"},
        Setting{"calibration", &ComponentEntry::calibration, "",
                "for a Camera: the file that ROS's camera_calibration wrote, for example \"ost.yaml\""},
        Internal{&ComponentEntry::name},
        Internal{&ComponentEntry::place},
        Internal{&ComponentEntry::places},
    };
};

/// The fields of the word `physics`.
struct PhysicsFields {
    double step = SystemSpec{}.physics_step;
};

template <>
struct Describe<PhysicsFields> {
    static constexpr std::string_view name = "physics";
    static constexpr std::string_view doc = "How the simulation runs.";
    static constexpr FieldList fields{
        Setting{"step",
                &PhysicsFields::step,
                "s",
                "duration of a physics step; a tick is a whole number of them",
                {.required = true, .range = NumberRange::positive, .least = 1 / fastest_rate}},
    };
};

}  // namespace nezumi
