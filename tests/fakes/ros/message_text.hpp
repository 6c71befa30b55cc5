// Messages of ROS 2 as `ros2 topic echo` shows them, on one line.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "ros_messages.h"

namespace ros_peer {

/// The text of one message: what `show` of its type puts there.
class Text {
public:
    template <class T>
    Text& operator()(const char* name, const T& value) {
        text_ += fmt::format("{}{}: ", text_.empty() || text_.back() == '{' ? "" : ", ", name);
        put(value);
        return *this;
    }
    template <class T>
    void put(const T& value) {
        if constexpr (std::is_arithmetic_v<T>) {
            text_ += fmt::format("{}", value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            text_ += fmt::format("\"{}\"", value);
        } else if constexpr (requires { value[0]; }) {
            text_ += '[';
            for (std::size_t i = 0; i < value.size(); ++i) {
                if (i > 0) text_ += ", ";
                put(value[i]);
            }
            text_ += ']';
        } else {
            text_ += '{';
            show(*this, value);
            text_ += '}';
        }
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

inline void show(Text& to, const builtin_interfaces::msg::dds_::Time_& m) {
    to("sec", m.sec())("nanosec", m.nanosec());
}

namespace of_std {
using namespace std_msgs::msg::dds_;
}
inline void show(Text& to, const of_std::Header_& m) { to("stamp", m.stamp())("frame_id", m.frame_id()); }
inline void show(Text& to, const of_std::Bool_& m) { to("data", m.data()); }
inline void show(Text& to, const of_std::Int16_& m) { to("data", m.data()); }
inline void show(Text& to, const of_std::Int32_& m) { to("data", m.data()); }
inline void show(Text& to, const of_std::Float32_& m) { to("data", m.data()); }
inline void show(Text& to, const of_std::Float64_& m) { to("data", m.data()); }
inline void show(Text& to, const of_std::String_& m) { to("data", m.data()); }
inline void show(Text& to, const of_std::MultiArrayDimension_& m) {
    to("label", m.label())("size", m.size())("stride", m.stride());
}
inline void show(Text& to, const of_std::MultiArrayLayout_& m) { to("dim", m.dim())("data_offset", m.data_offset()); }
inline void show(Text& to, const of_std::Int16MultiArray_& m) { to("layout", m.layout())("data", m.data()); }
inline void show(Text& to, const of_std::Int32MultiArray_& m) { to("layout", m.layout())("data", m.data()); }
inline void show(Text& to, const of_std::Float32MultiArray_& m) { to("layout", m.layout())("data", m.data()); }
inline void show(Text& to, const of_std::Float64MultiArray_& m) { to("layout", m.layout())("data", m.data()); }

namespace of_geometry {
using namespace geometry_msgs::msg::dds_;
}
inline void show(Text& to, const of_geometry::Vector3_& m) { to("x", m.x())("y", m.y())("z", m.z()); }
inline void show(Text& to, const of_geometry::Point_& m) { to("x", m.x())("y", m.y())("z", m.z()); }
inline void show(Text& to, const of_geometry::Quaternion_& m) { to("x", m.x())("y", m.y())("z", m.z())("w", m.w()); }
inline void show(Text& to, const of_geometry::Pose_& m) {
    to("position", m.position())("orientation", m.orientation());
}
inline void show(Text& to, const of_geometry::PoseStamped_& m) { to("header", m.header())("pose", m.pose()); }
inline void show(Text& to, const of_geometry::PoseWithCovariance_& m) {
    to("pose", m.pose())("covariance", m.covariance());
}
inline void show(Text& to, const of_geometry::Twist_& m) { to("linear", m.linear())("angular", m.angular()); }
inline void show(Text& to, const of_geometry::TwistStamped_& m) { to("header", m.header())("twist", m.twist()); }
inline void show(Text& to, const of_geometry::TwistWithCovariance_& m) {
    to("twist", m.twist())("covariance", m.covariance());
}
inline void show(Text& to, const of_geometry::Transform_& m) {
    to("translation", m.translation())("rotation", m.rotation());
}
inline void show(Text& to, const of_geometry::TransformStamped_& m) {
    to("header", m.header())("child_frame_id", m.child_frame_id())("transform", m.transform());
}

inline void show(Text& to, const rosgraph_msgs::msg::dds_::Clock_& m) { to("clock", m.clock()); }
inline void show(Text& to, const tf2_msgs::msg::dds_::TFMessage_& m) { to("transforms", m.transforms()); }
inline void show(Text& to, const nav_msgs::msg::dds_::Odometry_& m) {
    to("header", m.header())("child_frame_id", m.child_frame_id())("pose", m.pose())("twist", m.twist());
}

namespace of_sensor {
using namespace sensor_msgs::msg::dds_;
}
inline void show(Text& to, const of_sensor::LaserScan_& m) {
    to("header", m.header())("angle_min", m.angle_min())("angle_max", m.angle_max());
    to("angle_increment", m.angle_increment())("time_increment", m.time_increment())("scan_time", m.scan_time());
    to("range_min", m.range_min())("range_max", m.range_max())("ranges", m.ranges())("intensities", m.intensities());
}
inline void show(Text& to, const of_sensor::RangeOfHumble_& m) {
    to("header", m.header())("radiation_type", m.radiation_type())("field_of_view", m.field_of_view());
    to("min_range", m.min_range())("max_range", m.max_range())("range", m.range());
}
inline void show(Text& to, const of_sensor::Range_& m) {
    to("header", m.header())("radiation_type", m.radiation_type())("field_of_view", m.field_of_view());
    to("min_range", m.min_range())("max_range", m.max_range())("range", m.range())("variance", m.variance());
}
inline void show(Text& to, const of_sensor::Image_& m) {
    to("header", m.header())("height", m.height())("width", m.width())("encoding", m.encoding());
    to("is_bigendian", m.is_bigendian())("step", m.step())("data", m.data());
}
inline void show(Text& to, const of_sensor::CompressedImage_& m) {
    to("header", m.header())("format", m.format())("data", m.data());
}
inline void show(Text& to, const of_sensor::RegionOfInterest_& m) {
    to("x_offset", m.x_offset())("y_offset", m.y_offset())("height", m.height())("width", m.width());
    to("do_rectify", m.do_rectify());
}
inline void show(Text& to, const of_sensor::CameraInfo_& m) {
    to("header", m.header())("height", m.height())("width", m.width())("distortion_model", m.distortion_model());
    to("d", m.d())("k", m.k())("r", m.r())("p", m.p())("binning_x", m.binning_x())("binning_y", m.binning_y());
    to("roi", m.roi());
}
inline void show(Text& to, const of_sensor::Joy_& m) {
    to("header", m.header())("axes", m.axes())("buttons", m.buttons());
}

inline void show(Text& to, const my_msgs::msg::dds_::Corner_& m) { to("x", m.x())("y", m.y()); }
inline void show(Text& to, const my_msgs::msg::dds_::Obstacle_& m) {
    to("distance", m.distance())("label", m.label())("corners", m.corners())("colour", m.colour());
    to("count", m.count())("seen", m.seen());
}

}  // namespace ros_peer
