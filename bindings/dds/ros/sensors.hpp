// Messages of ROS 2 about what sensors measure, and plain values, as their public definitions have them
// (common_interfaces).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "bindings/dds/ros/geometry.hpp"
#include "engine/ports/describe.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::ros {

/// As from Jazzy on; Humble's has no `variance`.
struct Range {
    Header header;
    std::uint8_t radiation_type = 0;
    float field_of_view = 0;
    float min_range = 0;
    float max_range = 0;
    float range = 0;
    float variance = 0;
    bool operator==(const Range&) const = default;
};

struct LaserScan {
    Header header;
    float angle_min = 0;
    float angle_max = 0;
    float angle_increment = 0;
    float time_increment = 0;
    float scan_time = 0;
    float range_min = 0;
    float range_max = 0;
    std::vector<float> ranges;
    std::vector<float> intensities;
    bool operator==(const LaserScan&) const = default;
};

struct Image {
    Header header;
    std::uint32_t height = 0;
    std::uint32_t width = 0;
    std::string encoding;
    std::uint8_t is_bigendian = 0;
    std::uint32_t step = 0;
    Octets data;
    bool operator==(const Image&) const = default;
};

struct CompressedImage {
    Header header;
    std::string format;
    Octets data;
    bool operator==(const CompressedImage&) const = default;
};

struct RegionOfInterest {
    std::uint32_t x_offset = 0;
    std::uint32_t y_offset = 0;
    std::uint32_t height = 0;
    std::uint32_t width = 0;
    bool do_rectify = false;
    bool operator==(const RegionOfInterest&) const = default;
};

struct CameraInfo {
    Header header;
    std::uint32_t height = 0;
    std::uint32_t width = 0;
    std::string distortion_model;
    std::vector<double> d;
    std::array<double, 9> k{};
    std::array<double, 9> r{};
    std::array<double, 12> p{};
    std::uint32_t binning_x = 0;
    std::uint32_t binning_y = 0;
    RegionOfInterest roi;
    bool operator==(const CameraInfo&) const = default;
};

struct Joy {
    Header header;
    std::vector<float> axes;
    std::vector<std::int32_t> buttons;
    bool operator==(const Joy&) const = default;
};

struct Bool {
    bool data = false;
    bool operator==(const Bool&) const = default;
};

struct Int16 {
    std::int16_t data = 0;
    bool operator==(const Int16&) const = default;
};

struct Int32 {
    std::int32_t data = 0;
    bool operator==(const Int32&) const = default;
};

struct Float32 {
    float data = 0;
    bool operator==(const Float32&) const = default;
};

struct Float64 {
    double data = 0;
    bool operator==(const Float64&) const = default;
};

struct String {
    std::string data;
    bool operator==(const String&) const = default;
};

struct MultiArrayDimension {
    std::string label;
    std::uint32_t size = 0;
    std::uint32_t stride = 0;
    bool operator==(const MultiArrayDimension&) const = default;
};

struct MultiArrayLayout {
    std::vector<MultiArrayDimension> dim;
    std::uint32_t data_offset = 0;
    bool operator==(const MultiArrayLayout&) const = default;
};

struct Int16MultiArray {
    MultiArrayLayout layout;
    std::vector<std::int16_t> data;
    bool operator==(const Int16MultiArray&) const = default;
};

struct Int32MultiArray {
    MultiArrayLayout layout;
    std::vector<std::int32_t> data;
    bool operator==(const Int32MultiArray&) const = default;
};

struct Float32MultiArray {
    MultiArrayLayout layout;
    std::vector<float> data;
    bool operator==(const Float32MultiArray&) const = default;
};

struct Float64MultiArray {
    MultiArrayLayout layout;
    std::vector<double> data;
    bool operator==(const Float64MultiArray&) const = default;
};

}  // namespace nezumi::ros

namespace nezumi {

template <>
struct Describe<ros::Range> {
    using T = ros::Range;
    static constexpr std::string_view name = "sensor_msgs/msg/Range";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"radiation_type", &T::radiation_type, "", "0 ultrasound, 1 infrared"},
        Field{"field_of_view", &T::field_of_view, "rad", ""},
        Field{"min_range", &T::min_range, "m", ""},
        Field{"max_range", &T::max_range, "m", ""},
        Field{"range", &T::range, "m", ""},
        Field{"variance", &T::variance, "", "0: unknown"},
    };
};

template <>
struct Describe<ros::LaserScan> {
    using T = ros::LaserScan;
    static constexpr std::string_view name = "sensor_msgs/msg/LaserScan";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"angle_min", &T::angle_min, "rad", ""},
        Field{"angle_max", &T::angle_max, "rad", ""},
        Field{"angle_increment", &T::angle_increment, "rad", ""},
        Field{"time_increment", &T::time_increment, "s", ""},
        Field{"scan_time", &T::scan_time, "s", ""},
        Field{"range_min", &T::range_min, "m", ""},
        Field{"range_max", &T::range_max, "m", ""},
        Field{"ranges", &T::ranges, "m", ""},
        Field{"intensities", &T::intensities, "", ""},
    };
};

template <>
struct Describe<ros::Image> {
    using T = ros::Image;
    static constexpr std::string_view name = "sensor_msgs/msg/Image";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"height", &T::height, "px", ""},
        Field{"width", &T::width, "px", ""},
        Field{"encoding", &T::encoding, "", ""},
        Field{"is_bigendian", &T::is_bigendian, "", ""},
        Field{"step", &T::step, "", "bytes of a row"},
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::CompressedImage> {
    using T = ros::CompressedImage;
    static constexpr std::string_view name = "sensor_msgs/msg/CompressedImage";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"format", &T::format, "", "jpeg or png"},
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::RegionOfInterest> {
    using T = ros::RegionOfInterest;
    static constexpr std::string_view name = "sensor_msgs/msg/RegionOfInterest";
    static constexpr std::tuple fields{
        Field{"x_offset", &T::x_offset, "px", ""},   Field{"y_offset", &T::y_offset, "px", ""},
        Field{"height", &T::height, "px", ""},       Field{"width", &T::width, "px", ""},
        Field{"do_rectify", &T::do_rectify, "", ""},
    };
};

template <>
struct Describe<ros::CameraInfo> {
    using T = ros::CameraInfo;
    static constexpr std::string_view name = "sensor_msgs/msg/CameraInfo";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"height", &T::height, "px", ""},
        Field{"width", &T::width, "px", ""},
        Field{"distortion_model", &T::distortion_model, "", ""},
        Field{"d", &T::d, "", ""},
        Field{"k", &T::k, "", ""},
        Field{"r", &T::r, "", ""},
        Field{"p", &T::p, "", ""},
        Field{"binning_x", &T::binning_x, "", ""},
        Field{"binning_y", &T::binning_y, "", ""},
        Field{"roi", &T::roi, "", ""},
    };
};

template <>
struct Describe<ros::Joy> {
    using T = ros::Joy;
    static constexpr std::string_view name = "sensor_msgs/msg/Joy";
    static constexpr std::tuple fields{
        Field{"header", &T::header, "", "when and in which frame"},
        Field{"axes", &T::axes, "", ""},
        Field{"buttons", &T::buttons, "", ""},
    };
};

template <>
struct Describe<ros::Bool> {
    using T = ros::Bool;
    static constexpr std::string_view name = "std_msgs/msg/Bool";
    static constexpr std::tuple fields{
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Int16> {
    using T = ros::Int16;
    static constexpr std::string_view name = "std_msgs/msg/Int16";
    static constexpr std::tuple fields{
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Int32> {
    using T = ros::Int32;
    static constexpr std::string_view name = "std_msgs/msg/Int32";
    static constexpr std::tuple fields{
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Float32> {
    using T = ros::Float32;
    static constexpr std::string_view name = "std_msgs/msg/Float32";
    static constexpr std::tuple fields{
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Float64> {
    using T = ros::Float64;
    static constexpr std::string_view name = "std_msgs/msg/Float64";
    static constexpr std::tuple fields{
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::String> {
    using T = ros::String;
    static constexpr std::string_view name = "std_msgs/msg/String";
    static constexpr std::tuple fields{
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::MultiArrayDimension> {
    using T = ros::MultiArrayDimension;
    static constexpr std::string_view name = "std_msgs/msg/MultiArrayDimension";
    static constexpr std::tuple fields{
        Field{"label", &T::label, "", ""},
        Field{"size", &T::size, "", ""},
        Field{"stride", &T::stride, "", ""},
    };
};

template <>
struct Describe<ros::MultiArrayLayout> {
    using T = ros::MultiArrayLayout;
    static constexpr std::string_view name = "std_msgs/msg/MultiArrayLayout";
    static constexpr std::tuple fields{
        Field{"dim", &T::dim, "", ""},
        Field{"data_offset", &T::data_offset, "", ""},
    };
};

template <>
struct Describe<ros::Int16MultiArray> {
    using T = ros::Int16MultiArray;
    static constexpr std::string_view name = "std_msgs/msg/Int16MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &T::layout, "", ""},
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Int32MultiArray> {
    using T = ros::Int32MultiArray;
    static constexpr std::string_view name = "std_msgs/msg/Int32MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &T::layout, "", ""},
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Float32MultiArray> {
    using T = ros::Float32MultiArray;
    static constexpr std::string_view name = "std_msgs/msg/Float32MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &T::layout, "", ""},
        Field{"data", &T::data, "", ""},
    };
};

template <>
struct Describe<ros::Float64MultiArray> {
    using T = ros::Float64MultiArray;
    static constexpr std::string_view name = "std_msgs/msg/Float64MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &T::layout, "", ""},
        Field{"data", &T::data, "", ""},
    };
};

}  // namespace nezumi
