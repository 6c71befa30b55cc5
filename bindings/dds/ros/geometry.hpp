// Messages of ROS 2 about time and geometry, with the fields of their public definitions (common_interfaces).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/messages/ros_time.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::ros {

struct Header {
    Time stamp;
    std::string frame_id;
    bool operator==(const Header&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Header";
};

struct Clock {
    Time clock;  ///< of the simulation
    bool operator==(const Clock&) const = default;

    static constexpr std::string_view type_name = "rosgraph_msgs/msg/Clock";
};

struct Vector3 {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Vector3&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Vector3";
};

struct Point {
    double x = 0;  ///< [m]
    double y = 0;  ///< [m]
    double z = 0;  ///< [m]
    bool operator==(const Point&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Point";
};

struct Quaternion {
    double x = 0;
    double y = 0;
    double z = 0;
    double w = 1;
    bool operator==(const Quaternion&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Quaternion";
};

struct Pose {
    Point position;
    Quaternion orientation;
    bool operator==(const Pose&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Pose";
};

struct PoseStamped {
    Header header;  ///< when and in which frame
    Pose pose;
    bool operator==(const PoseStamped&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/PoseStamped";
};

struct PoseWithCovariance {
    Pose pose;
    std::array<double, 36> covariance{};
    bool operator==(const PoseWithCovariance&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/PoseWithCovariance";
};

struct Twist {
    Vector3 linear;   ///< [m/s]
    Vector3 angular;  ///< [rad/s]
    bool operator==(const Twist&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Twist";
};

struct TwistStamped {
    Header header;  ///< when and in which frame
    Twist twist;
    bool operator==(const TwistStamped&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/TwistStamped";
};

struct TwistWithCovariance {
    Twist twist;
    std::array<double, 36> covariance{};
    bool operator==(const TwistWithCovariance&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/TwistWithCovariance";
};

struct Transform {
    Vector3 translation;  ///< [m]
    Quaternion rotation;
    bool operator==(const Transform&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/Transform";
};

struct TransformStamped {
    Header header;  ///< when and in which frame
    std::string child_frame_id;
    Transform transform;
    bool operator==(const TransformStamped&) const = default;

    static constexpr std::string_view type_name = "geometry_msgs/msg/TransformStamped";
};

struct TFMessage {
    std::vector<TransformStamped> transforms;
    bool operator==(const TFMessage&) const = default;

    static constexpr std::string_view type_name = "tf2_msgs/msg/TFMessage";
};

struct Odometry {
    Header header;  ///< when and in which frame
    std::string child_frame_id;
    PoseWithCovariance pose;
    TwistWithCovariance twist;
    bool operator==(const Odometry&) const = default;

    static constexpr std::string_view type_name = "nav_msgs/msg/Odometry";
};

}  // namespace nezumi::ros
