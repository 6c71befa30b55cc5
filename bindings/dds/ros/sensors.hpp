// Messages of ROS 2 about sensors, and plain values, with the fields of their public definitions (common_interfaces).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "bindings/dds/ros/geometry.hpp"
#include "engine/ports/messages.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::ros {

/// As in Jazzy and later; in Humble `variance` is missing.
struct Range {
    Header header;
    std::uint8_t radiation_type = 0;
    float field_of_view = 0;
    float min_range = 0;
    float max_range = 0;
    float range = 0;
    float variance = 0;
    bool operator==(const Range&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/Range";
    static constexpr std::tuple fields{
        Field{"header", &Range::header, "", "when and in which frame"},
        Field{"radiation_type", &Range::radiation_type, "", "0 ultrasound, 1 infrared"},
        Field{"field_of_view", &Range::field_of_view, "rad", ""},
        Field{"min_range", &Range::min_range, "m", ""},
        Field{"max_range", &Range::max_range, "m", ""},
        Field{"range", &Range::range, "m", ""},
        Field{"variance", &Range::variance, "", "0: unknown"},
    };
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

    static constexpr std::string_view type_name = "sensor_msgs/msg/LaserScan";
    static constexpr std::tuple fields{
        Field{"header", &LaserScan::header, "", "when and in which frame"},
        Field{"angle_min", &LaserScan::angle_min, "rad", ""},
        Field{"angle_max", &LaserScan::angle_max, "rad", ""},
        Field{"angle_increment", &LaserScan::angle_increment, "rad", ""},
        Field{"time_increment", &LaserScan::time_increment, "s", ""},
        Field{"scan_time", &LaserScan::scan_time, "s", ""},
        Field{"range_min", &LaserScan::range_min, "m", ""},
        Field{"range_max", &LaserScan::range_max, "m", ""},
        Field{"ranges", &LaserScan::ranges, "m", ""},
        Field{"intensities", &LaserScan::intensities, "", ""},
    };
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

    static constexpr std::string_view type_name = "sensor_msgs/msg/Image";
    static constexpr std::tuple fields{
        Field{"header", &Image::header, "", "when and in which frame"},
        Field{"height", &Image::height, "px", ""},
        Field{"width", &Image::width, "px", ""},
        Field{"encoding", &Image::encoding, "", ""},
        Field{"is_bigendian", &Image::is_bigendian, "", ""},
        Field{"step", &Image::step, "", "bytes of a row"},
        Field{"data", &Image::data, "", ""},
    };
};

struct CompressedImage {
    Header header;
    std::string format;
    Octets data;
    bool operator==(const CompressedImage&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/CompressedImage";
    static constexpr std::tuple fields{
        Field{"header", &CompressedImage::header, "", "when and in which frame"},
        Field{"format", &CompressedImage::format, "", "jpeg or png"},
        Field{"data", &CompressedImage::data, "", ""},
    };
};

struct RegionOfInterest {
    std::uint32_t x_offset = 0;
    std::uint32_t y_offset = 0;
    std::uint32_t height = 0;
    std::uint32_t width = 0;
    bool do_rectify = false;
    bool operator==(const RegionOfInterest&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/RegionOfInterest";
    static constexpr std::tuple fields{
        Field{"x_offset", &RegionOfInterest::x_offset, "px", ""},
        Field{"y_offset", &RegionOfInterest::y_offset, "px", ""},
        Field{"height", &RegionOfInterest::height, "px", ""},
        Field{"width", &RegionOfInterest::width, "px", ""},
        Field{"do_rectify", &RegionOfInterest::do_rectify, "", ""},
    };
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

    static constexpr std::string_view type_name = "sensor_msgs/msg/CameraInfo";
    static constexpr std::tuple fields{
        Field{"header", &CameraInfo::header, "", "when and in which frame"},
        Field{"height", &CameraInfo::height, "px", ""},
        Field{"width", &CameraInfo::width, "px", ""},
        Field{"distortion_model", &CameraInfo::distortion_model, "", ""},
        Field{"d", &CameraInfo::d, "", ""},
        Field{"k", &CameraInfo::k, "", ""},
        Field{"r", &CameraInfo::r, "", ""},
        Field{"p", &CameraInfo::p, "", ""},
        Field{"binning_x", &CameraInfo::binning_x, "", ""},
        Field{"binning_y", &CameraInfo::binning_y, "", ""},
        Field{"roi", &CameraInfo::roi, "", ""},
    };
};

struct Joy {
    Header header;
    std::vector<float> axes;
    std::vector<std::int32_t> buttons;
    bool operator==(const Joy&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/Joy";
    static constexpr std::tuple fields{
        Field{"header", &Joy::header, "", "when and in which frame"},
        Field{"axes", &Joy::axes, "", ""},
        Field{"buttons", &Joy::buttons, "", ""},
    };
};

struct Bool {
    bool data = false;
    bool operator==(const Bool&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Bool";
    static constexpr std::tuple fields{
        Field{"data", &Bool::data, "", ""},
    };
};

struct Int16 {
    std::int16_t data = 0;
    bool operator==(const Int16&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int16";
    static constexpr std::tuple fields{
        Field{"data", &Int16::data, "", ""},
    };
};

struct Int32 {
    std::int32_t data = 0;
    bool operator==(const Int32&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int32";
    static constexpr std::tuple fields{
        Field{"data", &Int32::data, "", ""},
    };
};

struct Float32 {
    float data = 0;
    bool operator==(const Float32&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float32";
    static constexpr std::tuple fields{
        Field{"data", &Float32::data, "", ""},
    };
};

struct Float64 {
    double data = 0;
    bool operator==(const Float64&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float64";
    static constexpr std::tuple fields{
        Field{"data", &Float64::data, "", ""},
    };
};

struct String {
    std::string data;
    bool operator==(const String&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/String";
    static constexpr std::tuple fields{
        Field{"data", &String::data, "", ""},
    };
};

struct MultiArrayDimension {
    std::string label;
    std::uint32_t size = 0;
    std::uint32_t stride = 0;
    bool operator==(const MultiArrayDimension&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/MultiArrayDimension";
    static constexpr std::tuple fields{
        Field{"label", &MultiArrayDimension::label, "", ""},
        Field{"size", &MultiArrayDimension::size, "", ""},
        Field{"stride", &MultiArrayDimension::stride, "", ""},
    };
};

struct MultiArrayLayout {
    std::vector<MultiArrayDimension> dim;
    std::uint32_t data_offset = 0;
    bool operator==(const MultiArrayLayout&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/MultiArrayLayout";
    static constexpr std::tuple fields{
        Field{"dim", &MultiArrayLayout::dim, "", ""},
        Field{"data_offset", &MultiArrayLayout::data_offset, "", ""},
    };
};

struct Int16MultiArray {
    MultiArrayLayout layout;
    std::vector<std::int16_t> data;
    bool operator==(const Int16MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int16MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &Int16MultiArray::layout, "", ""},
        Field{"data", &Int16MultiArray::data, "", ""},
    };
};

struct Int32MultiArray {
    MultiArrayLayout layout;
    std::vector<std::int32_t> data;
    bool operator==(const Int32MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int32MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &Int32MultiArray::layout, "", ""},
        Field{"data", &Int32MultiArray::data, "", ""},
    };
};

struct Float32MultiArray {
    MultiArrayLayout layout;
    std::vector<float> data;
    bool operator==(const Float32MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float32MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &Float32MultiArray::layout, "", ""},
        Field{"data", &Float32MultiArray::data, "", ""},
    };
};

struct Float64MultiArray {
    MultiArrayLayout layout;
    std::vector<double> data;
    bool operator==(const Float64MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float64MultiArray";
    static constexpr std::tuple fields{
        Field{"layout", &Float64MultiArray::layout, "", ""},
        Field{"data", &Float64MultiArray::data, "", ""},
    };
};

}  // namespace nezumi::ros
