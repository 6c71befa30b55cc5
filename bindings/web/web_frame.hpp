// What a browser is shown of a tick: described, so that CDR and the page's decoder follow.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "engine/ports/describe.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::web {

struct WebRobot {
    std::uint32_t index = 0;
    double x = 0, y = 0, z = 0;
    double yaw = 0, pitch = 0, roll = 0;
    bool is_truth = false;
    bool collided = false;
    std::string touches{};
    std::vector<Point3D> contacts{};
    bool operator==(const WebRobot&) const = default;
};
struct WebThing {
    std::uint32_t index = 0;
    Pose3D pose{};
    bool operator==(const WebThing&) const = default;
};
struct WebMarker {
    std::uint32_t index = 0;
    Pose3D pose{};
    bool operator==(const WebMarker&) const = default;
};
struct WebRay {
    std::uint32_t robot = 0;
    Point3D from{};
    Point3D to{};
    bool hit = false;
    std::uint32_t distance = 0;
    bool operator==(const WebRay&) const = default;
};
struct WebPort {
    std::uint32_t index = 0;
    std::uint32_t count = 0;
    Octets payload{};
};
struct WebLeaf {
    std::string name;
    double value = 0;
    bool operator==(const WebLeaf&) const = default;
};
struct WebMember {
    std::string name;
    std::vector<WebLeaf> leaves{};
    bool operator==(const WebMember&) const = default;
};
struct WebFrame {
    double time = 0;
    std::int64_t tick = 0;
    bool running = false;
    double speed = 1;
    double late = 0;
    std::vector<WebRobot> robots{};
    std::vector<WebThing> things{};
    std::vector<WebMarker> markers{};
    std::vector<WebRay> rays{};
    std::vector<WebPort> ports{};
    std::vector<WebMember> members{};
};
struct WebPicture {
    std::string port;
    double tm = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Octets jpeg{};
};

/// The first 4 bytes of a binary message, little endian.
enum class BinaryKind : std::uint32_t {
    frame = 1,
    picture = 2,
    floor = 3,  ///< the file of the picture on the floor follows, as it is
};

}  // namespace nezumi::web

namespace nezumi {

template <>
struct Describe<web::WebRobot> {
    using T = web::WebRobot;
    static constexpr std::string_view name = "WebRobot";
    static constexpr std::tuple fields{
        Field{"index", &T::index, "", "its place in the system's robots"},
        Field{"x", &T::x, "m", ""},
        Field{"y", &T::y, "m", ""},
        Field{"z", &T::z, "m", "height over the floor"},
        Field{"yaw", &T::yaw, "rad", ""},
        Field{"pitch", &T::pitch, "rad", "before the yaw; positive: its front goes down"},
        Field{"roll", &T::roll, "rad", "before the pitch"},
        Field{"is_truth", &T::is_truth, "", "the world's truth; else its odometry"},
        Field{"collided", &T::collided, "", "it touches something but the floor"},
        Field{"touches", &T::touches, "", "what that is"},
        Field{"contacts", &T::contacts, "m", "where"},
    };
};
template <>
struct Describe<web::WebThing> {
    using T = web::WebThing;
    static constexpr std::string_view name = "WebThing";
    static constexpr std::tuple fields{Field{"index", &T::index, "", "its place in the arena's things"},
                                       Field{"pose", &T::pose, "", "of its centre"}};
};
template <>
struct Describe<web::WebMarker> {
    using T = web::WebMarker;
    static constexpr std::string_view name = "WebMarker";
    static constexpr std::tuple fields{Field{"index", &T::index, "", "its place in the system's markers"},
                                       Field{"pose", &T::pose, "", "of its centre"}};
};
template <>
struct Describe<web::WebRay> {
    using T = web::WebRay;
    static constexpr std::string_view name = "WebRay";
    static constexpr std::tuple fields{
        Field{"robot", &T::robot, "", "its place in the system's robots"},
        Field{"from", &T::from, "m", ""},
        Field{"to", &T::to, "m", "where it hits or ends"},
        Field{"hit", &T::hit, "", ""},
        Field{"distance", &T::distance, "", "its place in the robot's distances"},
    };
};
template <>
struct Describe<web::WebPort> {
    using T = web::WebPort;
    static constexpr std::string_view name = "WebPort";
    static constexpr std::tuple fields{
        Field{"index", &T::index, "", "its place in what is watched"},
        Field{"count", &T::count, "", "messages since the last one that was shown"},
        Field{"payload", &T::payload, "", "the latest message, as CDR"},
    };
};
template <>
struct Describe<web::WebLeaf> {
    using T = web::WebLeaf;
    static constexpr std::string_view name = "WebLeaf";
    static constexpr std::tuple fields{Field{"name", &T::name, "", "as in pose.position.x"},
                                       Field{"value", &T::value, "", "a truth value is 0 or 1"}};
};
template <>
struct Describe<web::WebMember> {
    using T = web::WebMember;
    static constexpr std::string_view name = "WebMember";
    static constexpr std::tuple fields{Field{"name", &T::name, "", "as in mouse.truth"},
                                       Field{"leaves", &T::leaves, "", "its numbers"}};
};
template <>
struct Describe<web::WebFrame> {
    using T = web::WebFrame;
    static constexpr std::string_view name = "WebFrame";
    static constexpr std::tuple fields{
        Field{"time", &T::time, "s", "of the system"},
        Field{"tick", &T::tick, "", ""},
        Field{"running", &T::running, "", "time passes"},
        Field{"speed", &T::speed, "", "a factor of real time; infinite: as fast as possible"},
        Field{"late", &T::late, "ms", "the latest tick"},
        Field{"robots", &T::robots, "", "that have changed"},
        Field{"things", &T::things, "", "that have changed"},
        Field{"markers", &T::markers, "", "that have changed"},
        Field{"rays", &T::rays, "", "all of each robot of which one has changed"},
        Field{"ports", &T::ports, "", "that have got messages"},
        Field{"members", &T::members, "", "that have changed, of those that are watched"},
    };
};
template <>
struct Describe<web::WebPicture> {
    using T = web::WebPicture;
    static constexpr std::string_view name = "WebPicture";
    static constexpr std::tuple fields{
        Field{"port", &T::port, "", ""},
        Field{"tm", &T::tm, "s", ""},
        Field{"width", &T::width, "", "pixels"},
        Field{"height", &T::height, "", "pixels"},
        Field{"jpeg", &T::jpeg, "", "the picture"},
    };
};

}  // namespace nezumi
