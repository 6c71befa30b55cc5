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
    static constexpr std::tuple fields{
        Setting{"model", &RobotEntry::model, "", "a robot's file, for example \"raspimouse\"", {.required = true}},
        Setting{"pose", &RobotEntry::pose, "", "where it starts"},
        Setting{"limits", &RobotEntry::limits, "", "instead of the model's"},
        Setting{"backend", &RobotEntry::backend, "",
                "\"sim\": simulated with --hw as well; or the driver that --hw uses"},
        Setting{"calibrated", &RobotEntry::calibrated, "",
                "use `NAME.calibration.lua` beside this file also in simulation"},
        Setting{"odometry_at_pose", &RobotEntry::odometry_at_pose, "",
                "its odometry starts at `pose`, in the arena's coordinates; otherwise at 0, 0, 0"},
        Setting{"active", &RobotEntry::active, "", "whether it is activated at the start"},
        Internal{&RobotEntry::name},
        Internal{&RobotEntry::place},
        Internal{&RobotEntry::description},
        Internal{&RobotEntry::changes},
        Internal{&RobotEntry::twin_of},
    };
};

template <>
struct Describe<BehaviorEntry> {
    static constexpr std::string_view name = "behavior";
    static constexpr std::string_view doc = "A component written in Lua.";
    static constexpr std::tuple fields{
        Setting{"script",
                &BehaviorEntry::script,
                "",
                "a behaviour's file, for example \"robot_controller\"",
                {.required = true}},
        Setting{"config", &BehaviorEntry::config, "", "values of its parameters"},
        Setting{"sets", &BehaviorEntry::sets, "", "values of parameters that are chosen together, by the set's name"},
        Setting{"set", &BehaviorEntry::set, "",
                "the parameter set in use; omitted parameters have the values of `config`"},
        Setting{"rate",
                &BehaviorEntry::rate,
                "Hz",
                "executions a second, at most the tick's",
                {.range = NumberRange::positive, .least = slowest_rate, .fallback = "the tick's"}},
        Setting{"active", &BehaviorEntry::active, "", "whether it is activated at the start"},
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
    static constexpr std::tuple fields{
        Setting{
            "type", &ComponentEntry::type, "", "a native component's type, for example \"Camera\"", {.required = true}},
        Setting{"config", &ComponentEntry::config, "", "values of its parameters"},
        Setting{"rate",
                &ComponentEntry::rate,
                "Hz",
                "executions a second, at most the tick's",
                {.range = NumberRange::positive, .least = slowest_rate, .fallback = "the type's own"}},
        Setting{"on", &ComponentEntry::on, "", "the robot that carries it"},
        Setting{"at", &ComponentEntry::at, "m", "on that robot, from the middle of the wheels' axis on the floor"},
        Setting{"yaw", &ComponentEntry::yaw, "rad", "on that robot, counter-clockwise"},
        Setting{"backend", &ComponentEntry::backend, "", "\"sim\": simulated with --hw as well"},
        Setting{"active", &ComponentEntry::active, "", "whether it is activated at the start"},
        Setting{"calibration", &ComponentEntry::calibration, "",
                "a Camera's: the file that ROS's camera_calibration wrote, for example \"ost.yaml\""},
        Internal{&ComponentEntry::name},
        Internal{&ComponentEntry::place},
        Internal{&ComponentEntry::places},
    };
};

namespace detail {
/// [1] the last domain that has ports (RTPS 2.5, 9.6.2.3)
inline constexpr std::int64_t last_domain = 232;
}  // namespace detail

template <>
struct Describe<NetworkSpec> {
    static constexpr std::string_view name = "network";
    static constexpr std::string_view doc =
        "This system is a host among others. Without the word nothing of it is on the network.";
    static constexpr std::tuple fields{
        Setting{"name", &NetworkSpec::name, "", "what other hosts call this one", {.required = true}},
        Setting{"domain",
                &NetworkSpec::domain,
                "",
                "hosts of one domain find each other",
                {.min = 0, .max = detail::last_domain}},
        Setting{"interface",
                &NetworkSpec::interface,
                "",
                "the network interface, for example \"wlan0\"",
                {.fallback = "the loopback: processes of this machine"}},
        Setting{"peers", &NetworkSpec::peers, "", "addresses of hosts, if the network has no multicast"},
        Setting{"secret",
                &NetworkSpec::secret,
                "",
                "a file that `nezumi network secret` has made: hosts that have it may write",
                {.fallback = "on the loopback this user's own"}},
        Setting{"open", &NetworkSpec::open, "",
                "every host on the interface, or every user of this computer, may write without a secret"},
        Setting{"lockstep", &NetworkSpec::lockstep, "",
                "connected simulations advance together, so that every run gives the same result"},
        Setting{"hosts", &NetworkSpec::hosts, "",
                "hosts that lockstep waits for before it begins, in addition to those of connections"},
        Internal{&NetworkSpec::secret_path},
        Internal{&NetworkSpec::place},
    };
};

/// One entry of `publish` or `subscribe`, if a name alone is not enough.
template <>
struct Describe<RosTopic> {
    static constexpr std::string_view name = "ros_topic";
    static constexpr std::string_view doc = "A topic of ROS 2, if a name alone is not enough.";
    static constexpr std::tuple fields{
        Setting{"topic", &RosTopic::topic, "", "of `publish`: its name, for example \"/odom\""},
        Setting{"port", &RosTopic::port, "", "of `subscribe`: the in-port, \"name.port\""},
        Setting{"type",
                &RosTopic::type,
                "",
                "the message's type, for example \"geometry_msgs/msg/TwistStamped\"",
                {.fallback = "the first for the port's type"}},
        Setting{"frame", &RosTopic::frame, "", "of the message's header", {.fallback = "what fits its type"}},
        Internal{&RosTopic::place},
    };
};

template <>
struct Describe<RosSpec> {
    static constexpr std::string_view name = "ros";
    static constexpr std::string_view doc = "This system is a node among those of ROS 2.";
    static constexpr std::tuple fields{
        Setting{"node", &RosSpec::node, "", "the node's name", {.required = true}},
        Extra{"publish", "table<string, string|RosTopicFields|any[]>", "",
              "out-ports and the topics that carry them: `[\"mouse.current_velocity_out\"] = \"/velocity\"`"},
        Extra{"subscribe", "table<string, string|RosTopicFields>", "",
              "topics and the in-ports that take them: `[\"/cmd_vel\"] = \"mouse.target_velocity_in\"`"},
        Setting{"domain",
                &RosSpec::domain,
                "",
                "the ROS_DOMAIN_ID of the other nodes",
                {.min = 0, .max = detail::last_domain}},
        Setting{"interface",
                &RosSpec::interface,
                "",
                "the network interface, for example \"wlan0\"",
                {.fallback = "the loopback: processes of this machine"}},
        Setting{"peers", &RosSpec::peers, "", "addresses of hosts, if the network has no multicast"},
        Internal{&RosSpec::publish},
        Internal{&RosSpec::subscribe},
        Internal{&RosSpec::place},
    };
};

template <>
struct Describe<RtmSpec> {
    static constexpr std::string_view name = "rtm";
    static constexpr std::string_view doc =
        "Components that are visible to OpenRTM-aist components and can be connected to them.";
    static constexpr std::tuple fields{
        Setting{"nameserver",
                &RtmSpec::nameserver,
                "",
                "\"HOST:PORT\" of the CORBA name service",
                {.adopt = adopt_nameserver}},
        Setting{"export", &RtmSpec::exported, "", "the components that appear there"},
        Setting{"interface",
                &RtmSpec::interface,
                "",
                "this computer's address, at which others reach them; by default only this computer reaches them",
                {.adopt = adopt_interface}},
        Setting{"rename", &RtmSpec::rename, "", "what a port is called there, by `\"name.port\"`"},
        Internal{&RtmSpec::place},
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
    static constexpr std::tuple fields{
        Setting{"step",
                &PhysicsFields::step,
                "s",
                "of time that the physics advances at once; a tick is a whole number of them",
                {.required = true, .range = NumberRange::positive, .least = 1 / fastest_rate}},
    };
};

}  // namespace nezumi
