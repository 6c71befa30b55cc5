// Messages of ROS 2 about time and space, as their public definitions have them (common_interfaces).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/ports/describe.hpp"

namespace nezumi::ros {

struct Time {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
    bool operator==(const Time&) const = default;
};

struct Header {
    Time stamp;
    std::string frame_id;
    bool operator==(const Header&) const = default;
};

struct Clock {
    Time clock;
    bool operator==(const Clock&) const = default;
};

struct Vector3 {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Vector3&) const = default;
};

struct Point {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Point&) const = default;
};

struct Quaternion {
    double x = 0;
    double y = 0;
    double z = 0;
    double w = 1;
    bool operator==(const Quaternion&) const = default;
};

struct Pose {
    Point position;
    Quaternion orientation;
    bool operator==(const Pose&) const = default;
};

struct PoseStamped {
    Header header;
    Pose pose;
    bool operator==(const PoseStamped&) const = default;
};

struct PoseWithCovariance {
    Pose pose;
    std::array<double, 36> covariance{};
    bool operator==(const PoseWithCovariance&) const = default;
};

struct Twist {
    Vector3 linear;
    Vector3 angular;
    bool operator==(const Twist&) const = default;
};

struct TwistStamped {
    Header header;
    Twist twist;
    bool operator==(const TwistStamped&) const = default;
};

struct TwistWithCovariance {
    Twist twist;
    std::array<double, 36> covariance{};
    bool operator==(const TwistWithCovariance&) const = default;
};

struct Transform {
    Vector3 translation;
    Quaternion rotation;
    bool operator==(const Transform&) const = default;
};

struct TransformStamped {
    Header header;
    std::string child_frame_id;
    Transform transform;
    bool operator==(const TransformStamped&) const = default;
};

struct TFMessage {
    std::vector<TransformStamped> transforms;
    bool operator==(const TFMessage&) const = default;
};

struct Odometry {
    Header header;
    std::string child_frame_id;
    PoseWithCovariance pose;
    TwistWithCovariance twist;
    bool operator==(const Odometry&) const = default;
};

}  // namespace nezumi::ros

namespace nezumi {

template <>
struct Describe<ros::Time> {
    using T = ros::Time;
    static constexpr std::string_view name = "builtin_interfaces/msg/Time";
    static constexpr std::tuple fields{
        Field{"sec", &T::sec, "s", "whole seconds"},
        Field{"nanosec", &T::nanosec, "ns", "the rest"},
    };
};

template <>
struct Describe<ros::Header> {
    using T = ros::Header;
    static constexpr std::string_view name = "std_msgs/msg/Header";
    static constexpr std::tuple fields{
        Field{"stamp", &T::stamp, "", ""},
        Field{"frame_id", &T::frame_id, "", ""},
    };
};

template <>
struct Describe<ros::Clock> {
    using T = ros::Clock;
    static constexpr std::string_view name = "rosgraph_msgs/msg/Clock";
    static constexpr std::tuple fields{
        Field{"clock", &T::clock, "", "of the simulation"},
    };
};

template <>
struct Describe<ros::Vector3> {
    using T = ros::Vector3;
    static constexpr std::string_view name = "geometry_msgs/msg/Vector3";
    static constexpr std::tuple fields{
        Field{"x", &T::x, "", ""},
        Field{"y", &T::y, "", ""},
        Field{"z", &T::z, "", ""},
    };
};

template <>
struct Describe<ros::Point> {
    using T = ros::Point;
    static constexpr std::string_view name = "geometry_msgs/msg/Point";
    static constexpr std::tuple fields{
        Field{"x", &T::x, "m", ""},
        Field{"y", &T::y, "m", ""},
        Field{"z", &T::z, "m", ""},
    };
};

template <>
struct Describe<ros::Quaternion> {
    using T = ros::Quaternion;
    static constexpr std::string_view name = "geometry_msgs/msg/Quaternion";
    static constexpr std::tuple fields{
        Field{"x", &T::x, "", ""},
        Field{"y", &T::y, "", ""},
        Field{"z", &T::z, "", ""},
        Field{"w", &T::w, "", ""},
    };
};

template <>
struct Describe<ros::Pose> {
    using T = ros::Pose;
    static constexpr std::string_view name = "geometry_msgs/msg/Pose";
    static constexpr std::tuple fields{
        Field{"position", &T::position, "", ""},
        Field{"orientation", &T::orientation, "", ""},
    };
};

template <>
struct Describe<ros::PoseStamped> {
    using T = ros::PoseStamped;
    static constexpr std::string_view name = "geometry_msgs/msg/PoseStamped";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"pose", &T::pose, "", ""},
    };
};

template <>
struct Describe<ros::PoseWithCovariance> {
    using T = ros::PoseWithCovariance;
    static constexpr std::string_view name = "geometry_msgs/msg/PoseWithCovariance";
    static constexpr std::tuple fields{
        Field{"pose", &T::pose, "", ""},
        Field{"covariance", &T::covariance, "", ""},
    };
};

template <>
struct Describe<ros::Twist> {
    using T = ros::Twist;
    static constexpr std::string_view name = "geometry_msgs/msg/Twist";
    static constexpr std::tuple fields{
        Field{"linear", &T::linear, "m/s", ""},
        Field{"angular", &T::angular, "rad/s", ""},
    };
};

template <>
struct Describe<ros::TwistStamped> {
    using T = ros::TwistStamped;
    static constexpr std::string_view name = "geometry_msgs/msg/TwistStamped";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"twist", &T::twist, "", ""},
    };
};

template <>
struct Describe<ros::TwistWithCovariance> {
    using T = ros::TwistWithCovariance;
    static constexpr std::string_view name = "geometry_msgs/msg/TwistWithCovariance";
    static constexpr std::tuple fields{
        Field{"twist", &T::twist, "", ""},
        Field{"covariance", &T::covariance, "", ""},
    };
};

template <>
struct Describe<ros::Transform> {
    using T = ros::Transform;
    static constexpr std::string_view name = "geometry_msgs/msg/Transform";
    static constexpr std::tuple fields{
        Field{"translation", &T::translation, "m", ""},
        Field{"rotation", &T::rotation, "", ""},
    };
};

template <>
struct Describe<ros::TransformStamped> {
    using T = ros::TransformStamped;
    static constexpr std::string_view name = "geometry_msgs/msg/TransformStamped";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"child_frame_id", &T::child_frame_id, "", ""},
        Field{"transform", &T::transform, "", ""},
    };
};

template <>
struct Describe<ros::TFMessage> {
    using T = ros::TFMessage;
    static constexpr std::string_view name = "tf2_msgs/msg/TFMessage";
    static constexpr std::tuple fields{
        Field{"transforms", &T::transforms, "", ""},
    };
};

template <>
struct Describe<ros::Odometry> {
    using T = ros::Odometry;
    static constexpr std::string_view name = "nav_msgs/msg/Odometry";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"child_frame_id", &T::child_frame_id, "", ""},
        Field{"pose", &T::pose, "", ""},
        Field{"twist", &T::twist, "", ""},
    };
};

}  // namespace nezumi
