// Converts payloads of ports to messages of ROS 2 and back. The sender fills in stamps and frames.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "bindings/dds/ros/geometry.hpp"
#include "bindings/dds/ros/sensors.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::ros {

/// Converts seconds to ROS's time with whole nanoseconds, and back. Times before 0 become 0.
Time to_time(double seconds);
double to_seconds(const Time& time);
/// Rotations about the z, y and x axes, in this order.
Quaternion to_quaternion(const Orientation3D& orientation);
Orientation3D to_orientation(const Quaternion& rotation);

// Both convert the first argument to the second. `from_ros` returns an error if that is impossible.
void to_ros(const Velocity2D& from, Twist& to);
void to_ros(const Velocity2D& from, TwistStamped& to);
void to_ros(const Pose2D& from, Odometry& to);
void to_ros(const Pose2D& from, TFMessage& to);
void to_ros(const Pose3D& from, PoseStamped& to);
void to_ros(const RangeData& from, Range& to);
void to_ros(const RangeData& from, LaserScan& to);
void to_ros(const CameraImage& from, Image& to);
void to_ros(const CameraImage& from, CompressedImage& to);
void to_ros(const CameraIntrinsics& from, CameraInfo& to);
void to_ros(const std::vector<float>& from, Joy& to);
void to_ros(const std::vector<bool>& from, Joy& to);

Expected<void> from_ros(const Twist& from, Velocity2D& to);
Expected<void> from_ros(const TwistStamped& from, Velocity2D& to);
Expected<void> from_ros(const Odometry& from, Pose2D& to);
Expected<void> from_ros(const PoseStamped& from, Pose3D& to);
Expected<void> from_ros(const Range& from, RangeData& to);
Expected<void> from_ros(const LaserScan& from, RangeData& to);
Expected<void> from_ros(const Image& from, CameraImage& to);
Expected<void> from_ros(const CompressedImage& from, CameraImage& to);
Expected<void> from_ros(const CameraInfo& from, CameraIntrinsics& to);
Expected<void> from_ros(const Joy& from, std::vector<float>& to);
Expected<void> from_ros(const Joy& from, std::vector<bool>& to);

/// A message with only the field `data`.
template <class T, class Message>
requires std::is_same_v<T, decltype(Message::data)>
void to_ros(const T& from, Message& to) { to.data = from; }
template <class T, class Message>
requires std::is_same_v<T, decltype(Message::data)> Expected<void> from_ros(const Message& from, T& to) {
    to = from.data;
    return {};
}

}  // namespace nezumi::ros
