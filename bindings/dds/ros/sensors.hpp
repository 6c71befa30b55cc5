// Messages of ROS 2 about sensors, and plain values, with the fields of their public definitions (common_interfaces).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/dds/ros/geometry.hpp"
#include "engine/ports/messages.hpp"
#include "engine/values/describe.hpp"

namespace nezumi::ros {

/// The definition of ROS 2 Jazzy and later. The one of Humble has no `variance`.
struct Range {
    Header header;                    ///< when and in which frame
    std::uint8_t radiation_type = 0;  ///< 0 ultrasound, 1 infrared
    float field_of_view = 0;          ///< [rad]
    float min_range = 0;              ///< [m]
    float max_range = 0;              ///< [m]
    float range = 0;                  ///< [m]
    float variance = 0;               ///< 0: unknown
    bool operator==(const Range&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/Range";
};

struct LaserScan {
    Header header;              ///< when and in which frame
    float angle_min = 0;        ///< [rad]
    float angle_max = 0;        ///< [rad]
    float angle_increment = 0;  ///< [rad]
    float time_increment = 0;   ///< [s]
    float scan_time = 0;        ///< [s]
    float range_min = 0;        ///< [m]
    float range_max = 0;        ///< [m]
    std::vector<float> ranges;  ///< [m]
    std::vector<float> intensities;
    bool operator==(const LaserScan&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/LaserScan";
};

struct Image {
    Header header;             ///< when and in which frame
    std::uint32_t height = 0;  ///< [px]
    std::uint32_t width = 0;   ///< [px]
    std::string encoding;
    std::uint8_t is_bigendian = 0;
    std::uint32_t step = 0;  ///< bytes of a row
    Octets data;
    bool operator==(const Image&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/Image";
};

struct CompressedImage {
    Header header;       ///< when and in which frame
    std::string format;  ///< jpeg or png
    Octets data;
    bool operator==(const CompressedImage&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/CompressedImage";
};

struct RegionOfInterest {
    std::uint32_t x_offset = 0;  ///< [px]
    std::uint32_t y_offset = 0;  ///< [px]
    std::uint32_t height = 0;    ///< [px]
    std::uint32_t width = 0;     ///< [px]
    bool do_rectify = false;
    bool operator==(const RegionOfInterest&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/RegionOfInterest";
};

struct CameraInfo {
    Header header;             ///< when and in which frame
    std::uint32_t height = 0;  ///< [px]
    std::uint32_t width = 0;   ///< [px]
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
};

struct Joy {
    Header header;  ///< when and in which frame
    std::vector<float> axes;
    std::vector<std::int32_t> buttons;
    bool operator==(const Joy&) const = default;

    static constexpr std::string_view type_name = "sensor_msgs/msg/Joy";
};

struct Bool {
    bool data = false;
    bool operator==(const Bool&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Bool";
};

struct Int16 {
    std::int16_t data = 0;
    bool operator==(const Int16&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int16";
};

struct Int32 {
    std::int32_t data = 0;
    bool operator==(const Int32&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int32";
};

struct Float32 {
    float data = 0;
    bool operator==(const Float32&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float32";
};

struct Float64 {
    double data = 0;
    bool operator==(const Float64&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float64";
};

struct String {
    std::string data;
    bool operator==(const String&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/String";
};

struct MultiArrayDimension {
    std::string label;
    std::uint32_t size = 0;
    std::uint32_t stride = 0;
    bool operator==(const MultiArrayDimension&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/MultiArrayDimension";
};

struct MultiArrayLayout {
    std::vector<MultiArrayDimension> dim;
    std::uint32_t data_offset = 0;
    bool operator==(const MultiArrayLayout&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/MultiArrayLayout";
};

struct Int16MultiArray {
    MultiArrayLayout layout;
    std::vector<std::int16_t> data;
    bool operator==(const Int16MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int16MultiArray";
};

struct Int32MultiArray {
    MultiArrayLayout layout;
    std::vector<std::int32_t> data;
    bool operator==(const Int32MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Int32MultiArray";
};

struct Float32MultiArray {
    MultiArrayLayout layout;
    std::vector<float> data;
    bool operator==(const Float32MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float32MultiArray";
};

struct Float64MultiArray {
    MultiArrayLayout layout;
    std::vector<double> data;
    bool operator==(const Float64MultiArray&) const = default;

    static constexpr std::string_view type_name = "std_msgs/msg/Float64MultiArray";
};

}  // namespace nezumi::ros
