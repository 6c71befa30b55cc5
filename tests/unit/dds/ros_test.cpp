// Messages of ROS 2: types, names, bytes, conversions, and a node among them.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "bindings/dds/network_maker.hpp"
#include "bindings/dds/ros/convert.hpp"
#include "bindings/dds/ros/mapping.hpp"
#include "bindings/dds/ros/node.hpp"
#include "bindings/dds/ros/type_hash.hpp"
#include "engine/ports/cdr.hpp"
#include "tests/unit/dds/host_rig.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using dds::FakeDomain;
using dds::Part;
using dds::RosNode;

namespace {

std::string hex(const Octets& data) {
    std::string text;
    for (const std::uint8_t byte : data) text += fmt::format("{:02x} ", byte);
    if (!text.empty()) text.pop_back();
    return text;
}

template <class M>
Octets bytes_of(const M& message) {
    Octets bytes;
    write_cdr(bytes, {.header = true}, message);
    return bytes;
}

// There and back.
template <class M, class T>
T around(const T& value) {
    M message;
    ros::to_ros(value, message);
    T back{};
    const auto read = ros::from_ros(message, back);
    REQUIRE(read.has_value());
    return back;
}

// A node in a system with one part, and another place in its domain.
struct NodeRig {
    explicit NodeRig(const RosSpec& spec, bool real = false)
        : system({.real_time = real, .clock = [this] { return clock; }},
                 [this](const LogLine& line) { log.push_back(line.text); }) {
        auto made = std::make_unique<Part>("part");
        part = made.get();
        REQUIRE(system.add(std::move(made)));
        REQUIRE(part->activate(system.now()));
        auto added =
            RosNode::add(system, spec, *place, {.clock = [this] { return clock; }, .wall_clock = [] { return 1.5e9; }});
        if (!added) refusal = describe(added.error());
    }
    RosNode& node() { return dynamic_cast<RosNode&>(*system.find("ros/mouse")); }
    void tick() {
        node().between_ticks();
        node().before_tick([this](const Act& act, const Actor& who) {
            arrivals.push_back(fmt::format("{} by {}", name_of(act), to_text(who)));
            return perform(system, std::get<Write>(act), who);
        });
        system.tick();
    }

    double clock = 100;
    FakeDomain domain;
    std::unique_ptr<dds::DdsTransport> place = domain.join();
    std::unique_ptr<dds::DdsTransport> other = domain.join();
    std::vector<std::string> log;
    std::vector<std::string> arrivals;  // acts of what came
    std::string refusal;
    System system;
    Part* part = nullptr;
};

RosSpec spec_of(std::vector<RosTopic> publish, std::vector<RosTopic> subscribe) {
    RosSpec spec;
    spec.node = "mouse";
    spec.publish = std::move(publish);
    spec.subscribe = std::move(subscribe);
    return spec;
}

}  // namespace

TEST_CASE("the hashes of types are those that ROS 2 publishes", "[dds][ros]") {
    CHECK(ros::type_hash<ros::String>() == "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
    CHECK(ros::type_hash<ros::Twist>() == "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
    CHECK(ros::type_hash<ros::Odometry>() == "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
    CHECK(ros::type_hash<ros::Image>() == "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47");
    CHECK(ros::type_hash<ros::LaserScan>() ==
          "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828");
    CHECK(ros::type_hash<ros::Range>() == "RIHS01_b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a");
    CHECK(ros::type_hash<ros::Float32>() == "RIHS01_7170d3d8f841f7be3172ce5f4f59f3a4d7f63b0447e8b33327601ad64d83d6e2");
}

TEST_CASE("topics and types are called as ROS 2 calls them on the wire", "[dds][ros]") {
    const auto twist = ros::find_mapping(type_index<Velocity2D>(), "", false);
    REQUIRE(twist.has_value());
    const dds::Topic written = ros::topic_of("/cmd_vel", **twist, true);
    CHECK(written.name == "rt/cmd_vel");
    CHECK(written.type == "geometry_msgs::msg::dds_::Twist_");
    CHECK(written.reliable);
    CHECK(written.user_data.starts_with("typehash=RIHS01_"));
    CHECK(written.user_data.back() == ';');
    const dds::Topic read = ros::topic_of("/cmd_vel", **twist, false);
    CHECK_FALSE(read.reliable);
    CHECK(read.depth == 1);
    const auto scan = ros::find_mapping(type_index<RangeData>(), "sensor_msgs/msg/LaserScan", false);
    REQUIRE(scan.has_value());
    CHECK_FALSE(ros::topic_of("/scan", **scan, true).reliable);
}

TEST_CASE("a type that a port does not become is told with those that it does", "[dds][ros]") {
    CHECK(ros::find_mapping(type_index<Velocity2D>(), "geometry_msgs/msg/Twst", false).error().message ==
          "TimedVelocity2D becomes no 'geometry_msgs/msg/Twst' (did you mean 'geometry_msgs/msg/Twist'?); there are "
          "geometry_msgs/msg/Twist, geometry_msgs/msg/TwistStamped");
    CHECK(ros::find_mapping(type_index<std::vector<std::string>>(), "", false).error().message ==
          "there is no type of ROS for TimedStringSeq");
    CHECK(ros::find_mapping(type_index<Pose2D>(), "tf2_msgs/msg/TFMessage", true)
              .error()
              .message.find("TimedPose2D is made of no 'tf2_msgs/msg/TFMessage'") == 0);
}

TEST_CASE("a stamped message is the bytes that the definitions of ROS give", "[dds][ros]") {
    ros::TwistStamped message;
    message.header = {{1, 2}, "odom"};
    message.twist.linear.x = 1;
    CHECK(hex(bytes_of(message)) ==
          "00 01 00 00 01 00 00 00 02 00 00 00 05 00 00 00 6f 64 6f 6d 00 00 00 00 "
          "00 00 00 00 00 00 00 00 00 00 f0 3f 00 00 00 00 00 00 00 00 00 00 00 00 "
          "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
          "00 00 00 00");
    ros::Odometry odometry;
    CHECK(bytes_of(odometry).size() == 4 + 8 + 4 + 1 + 3 + 4 + 1 + 3 + 56 + 288 + 48 + 288);
}

TEST_CASE("what goes to ROS and back is the same", "[dds][ros]") {
    const Velocity2D velocity{0.25, -0.5, 1.5};
    CHECK(around<ros::Twist>(velocity) == velocity);
    CHECK(around<ros::TwistStamped>(velocity) == velocity);
    const Pose2D pose{{1, -2}, 2.5};
    CHECK(around<ros::Odometry>(pose).position == pose.position);
    CHECK(around<ros::Odometry>(pose).heading == Approx(2.5));
    const Pose3D pose3{{1, 2, 3}, {0.1, -0.2, 0.3}};
    const Pose3D back = around<ros::PoseStamped>(pose3);
    CHECK(back.position == pose3.position);
    CHECK(back.orientation.r == Approx(0.1));
    CHECK(back.orientation.p == Approx(-0.2));
    CHECK(back.orientation.y == Approx(0.3));
    RangeData range;
    range.ranges = {0.5, 0.25};
    range.config = {.minAngle = -1, .maxAngle = 1, .angularRes = 2, .minRange = 0.125, .maxRange = 4, .frequency = 8};
    CHECK(around<ros::LaserScan>(range) == range);
    range.ranges = {0.5};
    CHECK(around<ros::Range>(range).ranges == range.ranges);
    CHECK(around<ros::Range>(range).config.maxRange == 4);
    const CameraImage image{2, 1, 24, "rgb8", 0, {1, 2, 3, 4, 5, 6}};
    CHECK(around<ros::Image>(image) == image);
    const CameraImage jpeg{.format = "jpeg", .pixels = {0xff, 0xd8}};
    CHECK(around<ros::CompressedImage>(jpeg) == jpeg);
    const CameraIntrinsics intrinsics{640, 480, 500, 501, 320, 240, 0.1, 0.2, 0.3, 0.4, 0.5};
    CHECK(around<ros::CameraInfo>(intrinsics) == intrinsics);
    CHECK(around<ros::Joy>(std::vector<float>{0.5F, -1}) == std::vector<float>{0.5F, -1});
    CHECK(around<ros::Joy>(std::vector<bool>{true, false}) == std::vector<bool>{true, false});
    CHECK(around<ros::String>(std::string("a")) == "a");
    CHECK(around<ros::Int32MultiArray>(std::vector<std::int32_t>{1, 2}) == std::vector<std::int32_t>{1, 2});
}

TEST_CASE("an infinite distance becomes the ranger's largest, and a picture of another encoding is refused",
          "[dds][ros]") {
    ros::Range message;
    message.max_range = 2;
    message.range = std::numeric_limits<float>::infinity();
    RangeData range;
    REQUIRE(ros::from_ros(message, range));
    CHECK(range.ranges == std::vector<double>{2});
    ros::Image image;
    image.encoding = "bayer_rggb8";
    CameraImage ours;
    CHECK(ros::from_ros(image, ours).error().message == "a picture of encoding 'bayer_rggb8': expected rgb8 or mono8");
    image.encoding = "mono8";
    image.width = 2;
    image.height = 2;
    image.step = 2;
    image.data = {1, 2, 3};
    CHECK_FALSE(ros::from_ros(image, ours));
}

TEST_CASE("times are whole nanoseconds", "[dds][ros]") {
    CHECK(ros::to_time(-1) == ros::Time{0, 0});
    CHECK(ros::to_time(1.25) == ros::Time{1, 250'000'000});
    CHECK(ros::to_time(1.9999999999) == ros::Time{2, 0});
    CHECK(ros::to_time(1e300).sec == std::numeric_limits<std::int32_t>::max());
    CHECK(ros::to_seconds({1, 500'000'000}) == 1.5);
}

TEST_CASE("a node publishes what ports carry, stamped by the simulation's time, and tells that time", "[dds][ros]") {
    NodeRig rig(spec_of({{"part.speed", "/velocity", "geometry_msgs/msg/TwistStamped"}}, {}));
    REQUIRE(rig.refusal.empty());
    const auto mapping = ros::find_mapping(type_index<Velocity2D>(), "geometry_msgs/msg/TwistStamped", false);
    const auto reader = rig.other->read(ros::topic_of("/velocity", **mapping, false));
    const auto clock = rig.other->read({.name = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_"});
    rig.tick();
    rig.part->speed.write({.vx = 0.5});
    rig.tick();
    const auto samples = reader->take();
    REQUIRE(samples.size() == 1);
    ros::TwistStamped message;
    REQUIRE(read_cdr(samples[0].bytes, {.header = true}, message));
    CHECK(message.twist.linear.x == 0.5);
    CHECK(message.header.frame_id == "base_link");
    CHECK(message.header.stamp == ros::Time{0, 10'000'000});
    const auto ticks = clock->take();
    REQUIRE(ticks.size() == 1);
    ros::Clock time;
    REQUIRE(read_cdr(ticks[0].bytes, {.header = true}, time));
    CHECK(time.clock == ros::Time{0, 10'000'000});
}

TEST_CASE("a node of real robots stamps by the time of day and has no clock of its own", "[dds][ros]") {
    NodeRig rig(spec_of({{"part.speed", "/velocity", "geometry_msgs/msg/TwistStamped"}}, {}), true);
    const auto mapping = ros::find_mapping(type_index<Velocity2D>(), "geometry_msgs/msg/TwistStamped", false);
    const auto reader = rig.other->read(ros::topic_of("/velocity", **mapping, false));
    rig.tick();
    rig.part->speed.write({.vx = 0.5});
    rig.tick();
    const auto samples = reader->take();
    REQUIRE(samples.size() == 1);
    ros::TwistStamped message;
    REQUIRE(read_cdr(samples[0].bytes, {.header = true}, message));
    CHECK(message.header.stamp.sec == 1'500'000'000);
    for (const std::string& topic : rig.domain.topics()) CHECK(topic.find("rt/clock") == std::string::npos);
}

TEST_CASE("a node takes what comes on topics, and nothing that is no message", "[dds][ros]") {
    NodeRig rig(spec_of({}, {{"part.target", "/cmd_vel"}}));
    REQUIRE(rig.refusal.empty());
    rig.tick();
    const auto mapping = ros::find_mapping(type_index<Velocity2D>(), "", true);
    const auto writer = rig.other->write(ros::topic_of("/cmd_vel", **mapping, true));
    ros::Twist twist;
    twist.linear.x = 0.1;
    twist.angular.z = -1;
    writer->write(bytes_of(twist));
    rig.tick();
    REQUIRE(rig.part->targets.size() == 1);
    CHECK(rig.part->targets[0].data == Velocity2D{0.1, 0, -1});
    CHECK(rig.arrivals == std::vector<std::string>{"Write by network ros"});
    const Octets wrong{0, 1, 0, 0, 9};
    for (int i = 0; i < 2; ++i) {
        writer->write(wrong);
        rig.tick();
    }
    twist.linear.x = std::numeric_limits<double>::infinity();
    writer->write(bytes_of(twist));
    rig.tick();
    CHECK(rig.part->targets.size() == 1);
    REQUIRE(rig.log.size() == 2);
    CHECK(rig.log[0].find("a message is not taken: byte 4") == 0);
    CHECK(rig.log[1] == "a message is not taken: a number is not finite");
}

TEST_CASE("a velocity that came while time stood moves nothing afterwards", "[dds][ros]") {
    const bool real = GENERATE(true, false);
    NodeRig rig(spec_of({}, {{"part.target", "/cmd_vel"}}), real);
    REQUIRE(rig.refusal.empty());
    rig.tick();
    const auto writer =
        rig.other->write(ros::topic_of("/cmd_vel", **ros::find_mapping(type_index<Velocity2D>(), "", true), true));
    writer->write(bytes_of(ros::Twist{}));
    if (!real) rig.node().between_ticks();  // of a simulation that is paused
    rig.clock += 0.6;
    rig.tick();
    CHECK(rig.arrivals.empty());
    writer->write(bytes_of(ros::Twist{}));
    rig.clock += 0.01;
    rig.tick();
    CHECK(rig.arrivals.size() == 1);
}

TEST_CASE("a simulation that is slower than the clock takes every velocity", "[dds][ros]") {
    NodeRig rig(spec_of({}, {{"part.target", "/cmd_vel"}}));
    rig.tick();
    const auto writer =
        rig.other->write(ros::topic_of("/cmd_vel", **ros::find_mapping(type_index<Velocity2D>(), "", true), true));
    writer->write(bytes_of(ros::Twist{}));
    rig.clock += 2;
    rig.tick();
    CHECK(rig.arrivals.size() == 1);
}

TEST_CASE("a range of Humble, which has no variance, is taken as well", "[dds][ros]") {
    const auto mapping = ros::find_mapping(type_index<RangeData>(), "sensor_msgs/msg/Range", true);
    REQUIRE(mapping.has_value());
    FakeDomain domain;
    const auto place = domain.join();
    const dds::Topic topic = ros::topic_of("/ir", **mapping, true);
    const auto subscription = (*mapping)->subscribe(place->read(topic));
    const auto writer = place->write(topic);
    ros::Range range;
    range.range = 0.5;
    Octets bytes = bytes_of(range);
    bytes.resize(bytes.size() - 4);
    writer->write(bytes);
    RangeData taken;
    CHECK(subscription->receive(1, [&](AnyPayload value) { taken = std::get<RangeData>(std::move(value)); }).empty());
    CHECK(taken.ranges == std::vector<double>{0.5});
}

TEST_CASE("a node says which topic it can't have", "[dds][ros]") {
    RosTopic topic{"part.sped", "/a"};
    topic.place = {"s.lua", 3, 5};
    CHECK(NodeRig(spec_of({topic}, {})).refusal ==
          "s.lua:3:5: ros: part.sped: part has no port 'sped' (did you mean 'speed'?)");
    CHECK(NodeRig(spec_of({{"part.target", "/a"}}, {})).refusal == "ros: part.target: an in-port can't be published");
    CHECK(NodeRig(spec_of({}, {{"part.speed", "/a"}})).refusal == "ros: /a: an out-port takes nothing from a topic");
    CHECK(NodeRig(spec_of({{"part.speed", "/a"}, {"part.count", "/a"}}, {})).refusal ==
          "ros: part.count: the topic /a is there already");
}

TEST_CASE("the documentation has the table of types of ROS as it is", "[dds][ros]") {
    std::ifstream page(source_root() + "/docs/network.md");
    std::ostringstream text;
    text << page.rdbuf();
    INFO(ros::mapping_table());
    CHECK(text.str().find(ros::mapping_table()) != std::string::npos);
}
