// The message types of ports, with OpenRTM-aist's names, each declared once.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/values/type.hpp"

namespace nezumi {

struct Point2D {
    double x = 0;
    double y = 0;
    bool operator==(const Point2D&) const = default;

    static constexpr FieldList fields{Field{"x", &Point2D::x, "m", ""}, Field{"y", &Point2D::y, "m", ""}};
};

struct Point3D {
    double x = 0;
    double y = 0;
    double z = 0;
    bool operator==(const Point3D&) const = default;

    static constexpr FieldList fields{Field{"x", &Point3D::x, "m", ""}, Field{"y", &Point3D::y, "m", ""},
                                      Field{"z", &Point3D::z, "m", ""}};
};

struct Orientation3D {
    double r = 0;
    double p = 0;
    double y = 0;
    bool operator==(const Orientation3D&) const = default;

    static constexpr FieldList fields{
        Field{"r", &Orientation3D::r, "rad", "roll about x"},
        Field{"p", &Orientation3D::p, "rad", "pitch about y"},
        Field{"y", &Orientation3D::y, "rad", "yaw about z, counter-clockwise"},
    };
};

struct Size3D {
    double l = 0;
    double w = 0;
    double h = 0;
    bool operator==(const Size3D&) const = default;

    static constexpr FieldList fields{Field{"l", &Size3D::l, "m", "along x"}, Field{"w", &Size3D::w, "m", "along y"},
                                      Field{"h", &Size3D::h, "m", "along z"}};
};

/// A velocity in the robot's own frame. The zero value means "stand still".
struct Velocity2D {
    double vx = 0;
    double vy = 0;
    double va = 0;
    bool operator==(const Velocity2D&) const = default;

    static constexpr FieldList fields{
        Field{"vx", &Velocity2D::vx, "m/s", "speed along the robot's x axis (forward)"},
        Field{"vy", &Velocity2D::vy, "m/s", "speed along the robot's y axis (left); 0 for two wheels that don't skid"},
        Field{"va", &Velocity2D::va, "rad/s", "yaw rate, counter-clockwise"},
    };
};

struct Pose2D {
    Point2D position;
    double heading = 0;
    bool operator==(const Pose2D&) const = default;

    static constexpr FieldList fields{
        Field{"position", &Pose2D::position, "", "place on the floor"},
        Field{"heading", &Pose2D::heading, "rad", "direction, counter-clockwise from the x axis"},
    };
};

struct Pose3D {
    Point3D position;
    Orientation3D orientation;
    bool operator==(const Pose3D&) const = default;

    static constexpr FieldList fields{
        Field{"position", &Pose3D::position, "", "place in space"},
        Field{"orientation", &Pose3D::orientation, "", "roll, pitch and yaw"},
    };
};

struct RangerElement {
    Pose3D pose;
    Size3D size;
    bool operator==(const RangerElement&) const = default;

    static constexpr FieldList fields{
        Field{"pose", &RangerElement::pose, "", "relative to the ranger"},
        Field{"size", &RangerElement::size, "", "extent of the element"},
    };
};

struct RangerGeometry {
    Pose3D pose;
    Size3D size;
    std::vector<RangerElement> elements;
    bool operator==(const RangerGeometry&) const = default;

    static constexpr FieldList fields{
        Field{"pose", &RangerGeometry::pose, "", "in the robot's frame"},
        Field{"size", &RangerGeometry::size, "", "extent of the device"},
        Field{"elements", &RangerGeometry::elements, "", "the single transducers of the ranger"},
    };
};

struct RangerConfig {
    double minAngle = 0;
    double maxAngle = 0;
    double angularRes = 0;
    double minRange = 0;
    double maxRange = 0;
    double rangeRes = 0;
    double frequency = 0;
    bool operator==(const RangerConfig&) const = default;

    static constexpr FieldList fields{
        Field{"minAngle", &RangerConfig::minAngle, "rad", "first scan angle"},
        Field{"maxAngle", &RangerConfig::maxAngle, "rad", "last scan angle"},
        Field{"angularRes", &RangerConfig::angularRes, "rad", "step from one scan angle to the next"},
        Field{"minRange", &RangerConfig::minRange, "m", "shortest distance it measures"},
        Field{"maxRange", &RangerConfig::maxRange, "m", "longest distance it measures"},
        Field{"rangeRes", &RangerConfig::rangeRes, "m", "resolution of a distance"},
        Field{"frequency", &RangerConfig::frequency, "Hz", "scans per second"},
    };
};

struct RangeData {
    std::vector<double> ranges;
    RangerGeometry geometry;
    RangerConfig config;
    bool operator==(const RangeData&) const = default;

    static constexpr FieldList fields{
        Field{"ranges", &RangeData::ranges, "m",
              "distances, one per scan angle; inf: nothing within reach, -inf: too near, nan: no reading (REP 117)",
              Numbers::any},
        Field{"geometry", &RangeData::geometry, "", "where the ranger is mounted"},
        Field{"config", &RangeData::config, "", "what the ranger can measure"},
    };
};

struct CameraImage {
    std::uint16_t width = 0;
    std::uint16_t height = 0;
    std::uint16_t bpp = 0;
    std::string format;
    double fDiv = 0;
    Octets pixels;
    bool operator==(const CameraImage&) const = default;

    static constexpr FieldList fields{
        Field{"width", &CameraImage::width, "px", ""},
        Field{"height", &CameraImage::height, "px", ""},
        Field{"bpp", &CameraImage::bpp, "bit", "bits per pixel"},
        Field{"format", &CameraImage::format, "", "how a pixel is stored, for example \"rgb8\" or \"gray8\""},
        Field{"fDiv", &CameraImage::fDiv, "", "scale factor of a compressed image"},
        Field{"pixels", &CameraImage::pixels, "", "the bytes, row by row from the top left; a string in Lua"},
    };
};

/// The projection of a camera: a pinhole, with the lens distortion of Brown and Conrady in OpenCV's form. A point x to
/// the right, y down and z in front of the camera has (a, b) = (x / z, y / z). With r2 = a^2 + b^2 and radial = (1 + k1
/// r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3), the distortion moves (a, b) to (a', b') = (a radial + 2
/// p1 a b + p2 (r2 + 2 a^2), b radial + p1 (r2 + 2 b^2) + 2 p2 a b). The pixel is at column cx + fx a' and row
/// cy + fy b'. The centre of the first pixel is (0, 0).
struct CameraIntrinsics {
    std::uint16_t width = 0;
    std::uint16_t height = 0;
    double fx = 0;
    double fy = 0;
    double cx = 0;
    double cy = 0;
    double k1 = 0;
    double k2 = 0;
    double p1 = 0;
    double p2 = 0;
    double k3 = 0;
    double k4 = 0;
    double k5 = 0;
    double k6 = 0;
    bool operator==(const CameraIntrinsics&) const = default;

    static constexpr FieldList fields{
        Field{"width", &CameraIntrinsics::width, "px", "width of the pictures"},
        Field{"height", &CameraIntrinsics::height, "px", ""},
        Field{"fx", &CameraIntrinsics::fx, "px", "focal length in x; 0: unknown"},
        Field{"fy", &CameraIntrinsics::fy, "px", "focal length in y"},
        Field{"cx", &CameraIntrinsics::cx, "px", "column of the optical axis"},
        Field{"cy", &CameraIntrinsics::cy, "px", "row of the optical axis"},
        Field{"k1", &CameraIntrinsics::k1, "", "radial distortion; below 0 a barrel, above a pincushion"},
        Field{"k2", &CameraIntrinsics::k2, "", "radial distortion"},
        Field{"p1", &CameraIntrinsics::p1, "", "tangential distortion"},
        Field{"p2", &CameraIntrinsics::p2, "", "tangential distortion"},
        Field{"k3", &CameraIntrinsics::k3, "", "radial distortion"},
        Field{"k4", &CameraIntrinsics::k4, "", "radial distortion of a rational model"},
        Field{"k5", &CameraIntrinsics::k5, "", "radial distortion of a rational model"},
        Field{"k6", &CameraIntrinsics::k6, "", "radial distortion of a rational model"},
    };
};

/// A fiducial marker in a camera picture, with its pose relative to the camera.
struct SeenMarker {
    std::int32_t id = 0;
    Pose3D pose;
    bool operator==(const SeenMarker&) const = default;

    static constexpr FieldList fields{
        Field{"id", &SeenMarker::id, "", "number of the marker"},
        Field{"pose", &SeenMarker::pose, "", "from the camera: x forward, y left, z up"},
    };
};

/// A robot nearby, as a sensor of kind `neighbours` sees it.
struct Neighbour {
    std::string name;
    double range = 0;
    double bearing = 0;
    std::vector<double> message;
    std::vector<bool> leds;
    bool operator==(const Neighbour&) const = default;

    static constexpr FieldList fields{
        Field{"name", &Neighbour::name, "", "of the robot"},
        Field{"range", &Neighbour::range, "m", "from the sensor to the robot's middle, seen from above"},
        Field{"bearing", &Neighbour::bearing, "rad", "counter-clockwise from the direction of the sensor"},
        Field{"message", &Neighbour::message, "", "the numbers that the robot sends to its neighbours, at most 10"},
        Field{"leds", &Neighbour::leds, "", "which of the robot's LEDs are on"},
    };
};

/// A compiled message type: its name on ports, and its payload without the stamp `tm`.
template <class T>
struct CompiledMessage {
    using Payload = T;
    std::string_view name;
    std::string_view doc;
};

/// All compiled message types. Files define others (engine/messages).
inline constexpr std::tuple compiled_messages{
    CompiledMessage<bool>{"TimedBoolean", "one boolean"},
    CompiledMessage<std::int16_t>{"TimedShort", "one 16-bit integer"},
    CompiledMessage<std::int32_t>{"TimedLong", "one 32-bit integer"},
    CompiledMessage<float>{"TimedFloat", "one 32-bit number"},
    CompiledMessage<double>{"TimedDouble", "one 64-bit number"},
    CompiledMessage<std::string>{"TimedString", "one string"},
    CompiledMessage<std::vector<bool>>{"TimedBooleanSeq", "a sequence of booleans"},
    CompiledMessage<std::vector<std::int16_t>>{"TimedShortSeq", "a sequence of 16-bit integers"},
    CompiledMessage<std::vector<std::int32_t>>{"TimedLongSeq", "a sequence of 32-bit integers"},
    CompiledMessage<std::vector<float>>{"TimedFloatSeq", "a sequence of 32-bit numbers"},
    CompiledMessage<std::vector<double>>{"TimedDoubleSeq", "a sequence of 64-bit numbers"},
    CompiledMessage<std::vector<std::string>>{"TimedStringSeq", "a sequence of strings"},
    CompiledMessage<Octets>{"TimedOctetSeq", "bytes, in Lua a string"},
    CompiledMessage<Velocity2D>{"TimedVelocity2D", "a velocity in the robot's own frame"},
    CompiledMessage<Pose2D>{"TimedPose2D", "a place and heading on the floor"},
    CompiledMessage<Pose3D>{"TimedPose3D", "a place and orientation in space"},
    CompiledMessage<RangeData>{"RangeData", "distances measured by a ranger"},
    CompiledMessage<CameraImage>{"CameraImage", "a picture"},
    CompiledMessage<CameraIntrinsics>{"CameraIntrinsics", "how a camera projects points in front of it to pixels"},
    CompiledMessage<std::vector<SeenMarker>>{"SeenMarkerSeq", "fiducial markers in sight"},
    CompiledMessage<std::vector<Neighbour>>{"NeighbourSeq",
                                            "robots in sight and the numbers that they send, the nearest first"},
};

inline constexpr std::size_t compiled_message_count = std::tuple_size_v<decltype(compiled_messages)>;

namespace detail {

/// The payload type at this index of `compiled_messages`.
template <std::size_t I>
using PayloadAt = typename std::tuple_element_t<I, decltype(compiled_messages)>::Payload;

/// The index of payload T in `compiled_messages`.
template <class T>
constexpr std::size_t place_of_payload() {
    return []<std::size_t... I>(std::index_sequence<I...>) {
        std::size_t found = compiled_message_count;
        ((std::is_same_v<PayloadAt<I>, T> ? (found = I, 0) : 0), ...);
        return found;
    }
    (std::make_index_sequence<compiled_message_count>{});
}

}  // namespace detail

/// The payload of a compiled message type.
template <class T>
concept Payload = detail::place_of_payload<T>()
< compiled_message_count;

}  // namespace nezumi
