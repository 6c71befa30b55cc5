// Messages of ROS 2 about time and geometry, with the fields of their public definitions (common_interfaces).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/values/describe.hpp"

namespace nezumi::ros {

struct Time {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
    bool operator==(const Time&) const = default;

    static constexpr std::string_view type_name = "builtin_interfaces/msg/Time";
    static constexpr std::tuple fields{
        Field{"sec", &Time::sec, "s", "whole seconds"},
        Field{"nanosec", &Time::nanosec, "ns", "the rest"},
    };
};

struct Header {
    Time stamp;
    std::string frame_id;
    bool operator==(const Header&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Header";
    static constexpr std::tuple fields{
        Field{"stamp", &Header::stamp, "", ""},
        Field{"frame_id", &Header::frame_id, "", ""},
    };
};

struct Clock {
    Time clock;
    bool operator==(const Clock&) const = default;

    static constexpr std::string_view type_name = "rosgraph_msgs/msg/Clock";
    static constexpr std::tuple fields{
        Field{"clock", &Clock::clock, "", "of the simulation"},
    };
};

struct Vector3 {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Vector3&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Vector3";
    static constexpr std::tuple fields{
        Field{"x", &Vector3::x, "", ""},
        Field{"y", &Vector3::y, "", ""},
        Field{"z", &Vector3::z, "", ""},
    };
};

struct Point {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Point&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Point";
    static constexpr std::tuple fields{
        Field{"x", &Point::x, "m", ""},
        Field{"y", &Point::y, "m", ""},
        Field{"z", &Point::z, "m", ""},
    };
};

struct Quaternion {
    double x = 0;
    double y = 0;
    double z = 0;
    double w = 1;
    bool operator==(const Quaternion&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Quaternion";
    static constexpr std::tuple fields{
        Field{"x", &Quaternion::x, "", ""},
        Field{"y", &Quaternion::y, "", ""},
        Field{"z", &Quaternion::z, "", ""},
        Field{"w", &Quaternion::w, "", ""},
    };
};

struct Pose {
    Point position;
    Quaternion orientation;
    bool operator==(const Pose&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Pose";
    static constexpr std::tuple fields{
        Field{"position", &Pose::position, "", ""},
        Field{"orientation", &Pose::orientation, "", ""},
    };
};

struct PoseStamped {
    Header header;
    Pose pose;
    bool operator==(const PoseStamped&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/PoseStamped";
    static constexpr std::tuple fields{
        Field{"header", &PoseStamped::header, "", "when and in which frame"},
        Field{"pose", &PoseStamped::pose, "", ""},
    };
};

struct PoseWithCovariance {
    Pose pose;
    std::array<double, 36> covariance{};
    bool operator==(const PoseWithCovariance&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/PoseWithCovariance";
    static constexpr std::tuple fields{
        Field{"pose", &PoseWithCovariance::pose, "", ""},
        Field{"covariance", &PoseWithCovariance::covariance, "", ""},
    };
};

struct Twist {
    Vector3 linear;
    Vector3 angular;
    bool operator==(const Twist&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Twist";
    static constexpr std::tuple fields{
        Field{"linear", &Twist::linear, "m/s", ""},
        Field{"angular", &Twist::angular, "rad/s", ""},
    };
};

struct TwistStamped {
    Header header;
    Twist twist;
    bool operator==(const TwistStamped&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/TwistStamped";
    static constexpr std::tuple fields{
        Field{"header", &TwistStamped::header, "", "when and in which frame"},
        Field{"twist", &TwistStamped::twist, "", ""},
    };
};

struct TwistWithCovariance {
    Twist twist;
    std::array<double, 36> covariance{};
    bool operator==(const TwistWithCovariance&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/TwistWithCovariance";
    static constexpr std::tuple fields{
        Field{"twist", &TwistWithCovariance::twist, "", ""},
        Field{"covariance", &TwistWithCovariance::covariance, "", ""},
    };
};

struct Transform {
    Vector3 translation;
    Quaternion rotation;
    bool operator==(const Transform&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Transform";
    static constexpr std::tuple fields{
        Field{"translation", &Transform::translation, "m", ""},
        Field{"rotation", &Transform::rotation, "", ""},
    };
};

struct TransformStamped {
    Header header;
    std::string child_frame_id;
    Transform transform;
    bool operator==(const TransformStamped&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/TransformStamped";
    static constexpr std::tuple fields{
        Field{"header", &TransformStamped::header, "", "when and in which frame"},
        Field{"child_frame_id", &TransformStamped::child_frame_id, "", ""},
        Field{"transform", &TransformStamped::transform, "", ""},
    };
};

struct TFMessage {
    std::vector<TransformStamped> transforms;
    bool operator==(const TFMessage&) const = default;

    static constexpr std::string_view type_name = "tf2_msgs/msg/TFMessage";
    static constexpr std::tuple fields{
        Field{"transforms", &TFMessage::transforms, "", ""},
    };
};

struct Odometry {
    Header header;
    std::string child_frame_id;
    PoseWithCovariance pose;
    TwistWithCovariance twist;
    bool operator==(const Odometry&) const = default;

    static constexpr std::string_view type_name = "nav_msgs/msg/Odometry";
    static constexpr std::tuple fields{
        Field{"header", &Odometry::header, "", "when and in which frame"},
        Field{"child_frame_id", &Odometry::child_frame_id, "", ""},
        Field{"pose", &Odometry::pose, "", ""},
        Field{"twist", &Odometry::twist, "", ""},
    };
};

}  // namespace nezumi::ros
