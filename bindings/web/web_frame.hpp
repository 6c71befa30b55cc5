// The state of a tick as shown in a browser: described types, from which CDR and the page's decoder are derived.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/ports/messages.hpp"
#include "engine/values/describe.hpp"

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

    static constexpr FieldList fields{
        Field{"index", &WebRobot::index, "", "its index among the system's robots"},
        Field{"x", &WebRobot::x, "m", ""},
        Field{"y", &WebRobot::y, "m", ""},
        Field{"z", &WebRobot::z, "m", "height over the floor"},
        Field{"yaw", &WebRobot::yaw, "rad", ""},
        Field{"pitch", &WebRobot::pitch, "rad", "rotation before the yaw; positive: the front is lower"},
        Field{"roll", &WebRobot::roll, "rad", "rotation before the pitch"},
        Field{"is_truth", &WebRobot::is_truth, "",
              "true: the pose is the true one, of the simulation; false: it is odometry"},
        Field{"collided", &WebRobot::collided, "", "the robot touches something other than the floor"},
        Field{"touches", &WebRobot::touches, "", "what the robot touches"},
        Field{"contacts", &WebRobot::contacts, "m", "where it touches"},
    };
};
struct WebThing {
    std::uint32_t index = 0;
    Pose3D pose{};
    bool operator==(const WebThing&) const = default;

    static constexpr FieldList fields{Field{"index", &WebThing::index, "", "its place in the arena's things"},
                                      Field{"pose", &WebThing::pose, "", "of its centre"}};
};
struct WebMarker {
    std::uint32_t index = 0;
    Pose3D pose{};
    bool operator==(const WebMarker&) const = default;

    static constexpr FieldList fields{Field{"index", &WebMarker::index, "", "its place in the system's markers"},
                                      Field{"pose", &WebMarker::pose, "", "of its centre"}};
};
struct WebRay {
    std::uint32_t robot = 0;
    Point3D from{};
    Point3D to{};
    bool hit = false;
    std::uint32_t distance = 0;
    bool operator==(const WebRay&) const = default;

    static constexpr FieldList fields{
        Field{"robot", &WebRay::robot, "", "its index among the system's robots"},
        Field{"from", &WebRay::from, "m", ""},
        Field{"to", &WebRay::to, "m", "the point that the ray hits, or its end"},
        Field{"hit", &WebRay::hit, "", ""},
        Field{"distance", &WebRay::distance, "", "its place in the robot's distances"},
    };
};
struct WebPort {
    std::uint32_t index = 0;
    std::uint32_t count = 0;
    Octets payload{};

    static constexpr FieldList fields{
        Field{"index", &WebPort::index, "", "its index among the watched values"},
        Field{"count", &WebPort::count, "", "messages since the last one shown"},
        Field{"payload", &WebPort::payload, "", "the latest message, as CDR"},
    };
};
struct WebLeaf {
    std::string name;
    double value = 0;
    bool operator==(const WebLeaf&) const = default;

    static constexpr FieldList fields{Field{"name", &WebLeaf::name, "", "as in pose.position.x"},
                                      Field{"value", &WebLeaf::value, "", "a boolean is 0 or 1"}};
};
struct WebMember {
    std::string name;
    std::vector<WebLeaf> leaves{};
    bool operator==(const WebMember&) const = default;

    static constexpr FieldList fields{Field{"name", &WebMember::name, "", "as in mouse.truth"},
                                      Field{"leaves", &WebMember::leaves, "", "its numbers"}};
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

    static constexpr FieldList fields{
        Field{"time", &WebFrame::time, "s", "of the system"},
        Field{"tick", &WebFrame::tick, "", ""},
        Field{"running", &WebFrame::running, "", "time passes"},
        Field{"speed", &WebFrame::speed, "", "a factor of real time; infinite: as fast as possible"},
        Field{"late", &WebFrame::late, "ms", "how late the latest tick was"},
        Field{"robots", &WebFrame::robots, "", "that have changed"},
        Field{"things", &WebFrame::things, "", "that have changed"},
        Field{"markers", &WebFrame::markers, "", "that have changed"},
        Field{"rays", &WebFrame::rays, "", "all rays of each robot with a changed ray"},
        Field{"ports", &WebFrame::ports, "", "that have got messages"},
        Field{"members", &WebFrame::members, "", "watched members that have changed"},
    };
};
struct WebPicture {
    std::string port;
    double tm = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Octets jpeg{};

    static constexpr FieldList fields{
        Field{"port", &WebPicture::port, "", ""},
        Field{"tm", &WebPicture::tm, "s", ""},
        Field{"width", &WebPicture::width, "", "pixels"},
        Field{"height", &WebPicture::height, "", "pixels"},
        Field{"jpeg", &WebPicture::jpeg, "", "the picture"},
    };
};

/// The first 4 bytes of a binary message, little endian.
enum class BinaryKind : std::uint32_t {
    frame = 1,
    picture = 2,
    floor = 3,  ///< followed by the unchanged file of the floor's picture
};

}  // namespace nezumi::web
