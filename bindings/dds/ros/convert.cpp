// Units are SI on both sides; axes are those of ROS (REP 103): x forward, y left, z up.
#include "bindings/dds/ros/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace nezumi::ros {
namespace {

constexpr double nanoseconds = 1e9;

Quaternion about_z(double heading) { return {0, 0, std::sin(heading / 2), std::cos(heading / 2)}; }

double heading_of(const Quaternion& q) { return to_orientation(q).y; }

// Our names of pixel formats, and ROS's (sensor_msgs/image_encodings.hpp). If one of our formats is listed twice, the
// first line is used for sending. The 8UC names are OpenCV's, whose colours begin with blue.
struct Encoding {
    std::string_view ours, theirs;
    std::uint16_t bits;
};
constexpr std::array<Encoding, 13> encodings{{{"rgb8", "rgb8", 24},
                                              {"bgr8", "bgr8", 24},
                                              {"gray8", "mono8", 8},
                                              {"rgba8", "rgba8", 32},
                                              {"bgra8", "bgra8", 32},
                                              {"mono16", "mono16", 16},
                                              {"yuv422_yuy2", "yuv422_yuy2", 16},
                                              {"yuv422", "yuv422", 16},
                                              {"bgr8", "8UC3", 24},
                                              {"gray8", "8UC1", 8},
                                              {"bgra8", "8UC4", 32},
                                              {"yuv422_yuy2", "yuyv", 16},
                                              {"yuv422", "uyvy", 16}}};
// Compressed formats, which have the same names in ROS.
constexpr std::array<std::string_view, 2> compressed{"jpeg", "png"};

std::uint32_t whole(std::size_t value) {
    return static_cast<std::uint32_t>(std::min<std::size_t>(value, std::numeric_limits<std::uint32_t>::max()));
}

// Converts a distance to ROS's convention (REP 117): infinity if nothing is within range, where our sensors give their
// largest distance; minus infinity if the object is too near to be measured.
float to_range(double range, const RangerConfig& config) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    if (config.maxRange > 0 && range >= config.maxRange) return infinite;
    return range < config.minRange ? -infinite : static_cast<float>(range);
}

}  // namespace

Time to_time(double seconds) {
    if (!(seconds > 0)) return {};
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    const double whole = std::min(std::floor(seconds), most);
    const auto rest =
        static_cast<std::uint32_t>(std::clamp(std::round((seconds - whole) * nanoseconds), 0.0, nanoseconds));
    if (rest < nanoseconds) return {static_cast<std::int32_t>(whole), rest};
    return {static_cast<std::int32_t>(std::min(whole + 1, most)), 0};
}

double to_seconds(const Time& time) { return time.sec + time.nanosec / nanoseconds; }

// Diebel, "Representing Attitude", 2006: the sequence (1, 2, 3).
Quaternion to_quaternion(const Orientation3D& o) {
    const double cr = std::cos(o.r / 2), sr = std::sin(o.r / 2);
    const double cp = std::cos(o.p / 2), sp = std::sin(o.p / 2);
    const double cy = std::cos(o.y / 2), sy = std::sin(o.y / 2);
    return {.x = sr * cp * cy - cr * sp * sy,
            .y = cr * sp * cy + sr * cp * sy,
            .z = cr * cp * sy - sr * sp * cy,
            .w = cr * cp * cy + sr * sp * sy};
}

Orientation3D to_orientation(const Quaternion& q) {
    return {.r = std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)),
            .p = std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0)),
            .y = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))};
}

void to_ros(const Velocity2D& from, Twist& to) {
    to.linear = {from.vx, from.vy, 0};
    to.angular = {0, 0, from.va};
}
void to_ros(const Velocity2D& from, TwistStamped& to) { to_ros(from, to.twist); }

Expected<void> from_ros(const Twist& from, Velocity2D& to) {
    to = {from.linear.x, from.linear.y, from.angular.z};
    return {};
}
Expected<void> from_ros(const TwistStamped& from, Velocity2D& to) { return from_ros(from.twist, to); }

void to_ros(const Pose2D& from, Odometry& to) {
    to.child_frame_id = "base_link";
    to.pose.pose = {{from.position.x, from.position.y, 0}, about_z(from.heading)};
}
void to_ros(const Pose2D& from, TFMessage& to) {
    to.transforms.resize(1);
    to.transforms[0].child_frame_id = "base_link";
    to.transforms[0].transform = {{from.position.x, from.position.y, 0}, about_z(from.heading)};
}
Expected<void> from_ros(const Odometry& from, Pose2D& to) {
    to = {{from.pose.pose.position.x, from.pose.pose.position.y}, heading_of(from.pose.pose.orientation)};
    return {};
}

void to_ros(const Pose3D& from, PoseStamped& to) {
    to.pose = {{from.position.x, from.position.y, from.position.z}, to_quaternion(from.orientation)};
}
Expected<void> from_ros(const PoseStamped& from, Pose3D& to) {
    const Point& at = from.pose.position;
    to = {{at.x, at.y, at.z}, to_orientation(from.pose.orientation)};
    return {};
}

void to_ros(const RangeData& from, Range& to) {
    to.radiation_type = 1;
    to.field_of_view = static_cast<float>(from.config.angularRes);
    to.min_range = static_cast<float>(from.config.minRange);
    to.max_range = static_cast<float>(from.config.maxRange);
    to.range =
        from.ranges.empty() ? std::numeric_limits<float>::quiet_NaN() : to_range(from.ranges.front(), from.config);
}
Expected<void> from_ros(const Range& from, RangeData& to) {
    to = {};
    to.ranges = {from.range};
    to.config.angularRes = from.field_of_view;
    to.config.minRange = from.min_range;
    to.config.maxRange = from.max_range;
    return {};
}

void to_ros(const RangeData& from, LaserScan& to) {
    const RangerConfig& config = from.config;
    to.angle_min = static_cast<float>(config.minAngle);
    to.angle_max = static_cast<float>(config.maxAngle);
    to.angle_increment = static_cast<float>(config.angularRes);
    to.scan_time = config.frequency > 0 ? static_cast<float>(1 / config.frequency) : 0;
    to.range_min = static_cast<float>(config.minRange);
    to.range_max = static_cast<float>(config.maxRange);
    to.ranges.clear();
    for (const double range : from.ranges) to.ranges.push_back(to_range(range, config));
}
Expected<void> from_ros(const LaserScan& from, RangeData& to) {
    to = {};
    to.ranges.assign(from.ranges.begin(), from.ranges.end());
    to.config = {.minAngle = from.angle_min,
                 .maxAngle = from.angle_max,
                 .angularRes = from.angle_increment,
                 .minRange = from.range_min,
                 .maxRange = from.range_max,
                 .rangeRes = 0,
                 .frequency = from.scan_time > 0 ? 1 / from.scan_time : 0};
    return {};
}

void to_ros(const CameraImage& from, Image& to) {
    const auto found = std::find_if(encodings.begin(), encodings.end(), [&](const Encoding& each) {
        return from.format.empty() ? each.bits == from.bpp : each.ours == from.format;
    });
    to.encoding = found != encodings.end() ? std::string(found->theirs) : from.format;
    to.height = from.height;
    to.width = from.width;
    to.step = from.height > 0 ? whole(from.pixels.size() / from.height) : 0;
    to.data = from.pixels;
}
Expected<void> from_ros(const Image& from, CameraImage& to) {
    const auto found = std::find_if(encodings.begin(), encodings.end(),
                                    [&](const Encoding& each) { return each.theirs == from.encoding; });
    if (found == encodings.end())
        return failure(
            fmt::format("a picture of encoding '{}': expected rgb8, bgr8, rgba8, bgra8, mono8, mono16, yuv422_yuy2 or "
                        "yuv422",
                        shown(from.encoding)));
    constexpr std::uint32_t most = std::numeric_limits<std::uint16_t>::max();
    const std::size_t row = std::size_t{from.width} * found->bits / 8;
    if (from.width > most || from.height > most || from.step < row ||
        from.data.size() < std::size_t{from.step} * from.height)
        return failure(
            fmt::format("a picture of {} x {} pixels with {} bytes in rows of {}: too large, or too few bytes",
                        from.width, from.height, from.data.size(), from.step));
    to.width = static_cast<std::uint16_t>(from.width);
    to.height = static_cast<std::uint16_t>(from.height);
    to.bpp = found->bits;
    to.format = found->ours;
    to.fDiv = 0;
    to.pixels.clear();
    for (std::size_t y = 0; y < from.height; ++y) {
        const auto begin = from.data.begin() + static_cast<std::ptrdiff_t>(y * from.step);
        to.pixels.insert(to.pixels.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
    }
    if (to.format == "mono16" && from.is_bigendian != 0) {
        for (std::size_t i = 0; i + 1 < to.pixels.size(); i += 2) std::swap(to.pixels[i], to.pixels[i + 1]);
    }
    return {};
}

void to_ros(const CameraImage& from, CompressedImage& to) {
    to.format = from.format;
    to.data = from.pixels;
}
Expected<void> from_ros(const CompressedImage& from, CameraImage& to) {
    // "jpeg", or the form of image_transport: "rgb8; jpeg compressed bgr8"
    for (const std::string_view format : compressed) {
        if (from.format.find(format) == std::string::npos) continue;
        to = {.format = std::string(format), .pixels = from.data};
        return {};
    }
    return failure(fmt::format("a picture of format '{}': expected jpeg or png", shown(from.format)));
}

void to_ros(const CameraIntrinsics& from, CameraInfo& to) {
    to.height = from.height;
    to.width = from.width;
    to.distortion_model = "plumb_bob";
    to.d = {from.k1, from.k2, from.p1, from.p2, from.k3};
    if (from.k4 != 0 || from.k5 != 0 || from.k6 != 0) {
        to.distortion_model = "rational_polynomial";
        to.d.insert(to.d.end(), {from.k4, from.k5, from.k6});
    }
    to.k = {from.fx, 0, from.cx, 0, from.fy, from.cy, 0, 0, 1};
    to.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    to.p = {from.fx, 0, from.cx, 0, 0, from.fy, from.cy, 0, 0, 0, 1, 0};
}
Expected<void> from_ros(const CameraInfo& from, CameraIntrinsics& to) {
    constexpr std::uint32_t most = std::numeric_limits<std::uint16_t>::max();
    const bool is_rational = from.distortion_model == "rational_polynomial";
    if (from.distortion_model != "plumb_bob" && !is_rational && !from.d.empty())
        return failure(fmt::format("the distortion model '{}': expected plumb_bob or rational_polynomial",
                                   shown(from.distortion_model)));
    if (from.width > most || from.height > most)
        return failure(
            fmt::format("a camera of {} x {} pixels: expected at most 65535 x 65535", from.width, from.height));
    const auto d = [&](std::size_t i) { return i < from.d.size() && (i < 5 || is_rational) ? from.d[i] : 0; };
    to = {.width = static_cast<std::uint16_t>(from.width),
          .height = static_cast<std::uint16_t>(from.height),
          .fx = from.k[0],
          .fy = from.k[4],
          .cx = from.k[2],
          .cy = from.k[5],
          .k1 = d(0),
          .k2 = d(1),
          .p1 = d(2),
          .p2 = d(3),
          .k3 = d(4),
          .k4 = d(5),
          .k5 = d(6),
          .k6 = d(7)};
    return {};
}

void to_ros(const std::vector<float>& from, Joy& to) { to.axes = from; }
void to_ros(const std::vector<bool>& from, Joy& to) { to.buttons.assign(from.begin(), from.end()); }
Expected<void> from_ros(const Joy& from, std::vector<float>& to) {
    to = from.axes;
    return {};
}
Expected<void> from_ros(const Joy& from, std::vector<bool>& to) {
    to.assign(from.buttons.size(), false);
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from.buttons[i] != 0;
    return {};
}

}  // namespace nezumi::ros
