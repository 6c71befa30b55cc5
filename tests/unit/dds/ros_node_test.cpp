// A system as a node among those of ROS 2.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "bindings/dds/network_maker.hpp"
#include "bindings/dds/ros/convert.hpp"
#include "bindings/dds/ros/mapping.hpp"
#include "tests/unit/dds/node_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

// What a robot of ROS is told since the last look: forward speeds, of Twist.
std::vector<double> speeds(Reader& reader) {
    std::vector<double> all;
    for (const TopicSample& sample : reader.take()) {
        ros::Twist twist;
        REQUIRE(read_cdr(sample.bytes, {.header = true}, twist));
        all.push_back(twist.linear.x);
    }
    return all;
}

// A node that commands a robot of ROS, which has been told to go.
struct CommandRig : NodeRig {
    CommandRig() : NodeRig(spec_of({{"part.speed", "/cmd_vel", "geometry_msgs/msg/Twist"}}, {})) {
        const auto mapping = ros::find_mapping(message_of<Velocity2D>(), "geometry_msgs/msg/Twist", false);
        robot = other->read(ros::topic_of("/cmd_vel", *mapping, false));
        tick();
        go();
        CHECK(speeds(*robot) == std::vector<double>{0.5});
    }
    void go() {
        part->speed.write({.vx = 0.5});
        tick();
    }
    std::unique_ptr<Reader> robot;
};

}  // namespace

TEST_CASE("a node publishes ports' messages with the simulation's time, and publishes that time", "[dds][ros]") {
    NodeRig rig(spec_of({{"part.speed", "/velocity", "geometry_msgs/msg/TwistStamped"}}, {}));
    REQUIRE(rig.refusal.empty());
    const auto mapping = ros::find_mapping(message_of<Velocity2D>(), "geometry_msgs/msg/TwistStamped", false);
    const auto reader = rig.other->read(ros::topic_of("/velocity", *mapping, false));
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

TEST_CASE("a node of real robots uses the time of day and publishes no clock", "[dds][ros]") {
    NodeRig rig(spec_of({{"part.speed", "/velocity", "geometry_msgs/msg/TwistStamped"}}, {}), true);
    const auto mapping = ros::find_mapping(message_of<Velocity2D>(), "geometry_msgs/msg/TwistStamped", false);
    const auto reader = rig.other->read(ros::topic_of("/velocity", *mapping, false));
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

TEST_CASE("a node takes valid messages from topics and rejects others", "[dds][ros]") {
    NodeRig rig(spec_of({}, {{"part.target", "/cmd_vel"}}));
    REQUIRE(rig.refusal.empty());
    rig.tick();
    const auto mapping = ros::find_mapping(message_of<Velocity2D>(), "", true);
    const auto writer = rig.other->write(ros::topic_of("/cmd_vel", *mapping, true));
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
    CHECK(rig.log[0].find("a message was rejected: byte 4") == 0);
    CHECK(rig.log[1] == "a message was rejected: a number is not finite");
}

TEST_CASE("a velocity that came while time stood has no effect afterwards", "[dds][ros]") {
    const bool real = GENERATE(true, false);
    NodeRig rig(spec_of({}, {{"part.target", "/cmd_vel"}}), real);
    REQUIRE(rig.refusal.empty());
    rig.tick();
    const auto writer =
        rig.other->write(ros::topic_of("/cmd_vel", *ros::find_mapping(message_of<Velocity2D>(), "", true), true));
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
        rig.other->write(ros::topic_of("/cmd_vel", *ros::find_mapping(message_of<Velocity2D>(), "", true), true));
    writer->write(bytes_of(ros::Twist{}));
    rig.clock += 2;
    rig.tick();
    CHECK(rig.arrivals.size() == 1);
}

TEST_CASE("an odometry has the velocity of its robot, or that of its poses", "[dds][ros]") {
    const auto mapping = ros::find_mapping(message_of<Pose2D>(), "nav_msgs/msg/Odometry", false);
    REQUIRE(mapping.has_value());
    FakeDomain domain;
    const auto here = domain.join(), there = domain.join();
    const dds::Topic topic = ros::topic_of("/odom", *mapping, true);
    const auto reader = there->read(topic);
    const auto port = make_in_port(message_of<Pose2D>(), "odom", "", 0);
    const auto publication = mapping->publish(*port, here->write(topic), "odom");
    const auto sent = [&](const Pose2D& pose, std::int64_t tick, const Velocity2D* measured) {
        port->inject(pose);
        port->latch({.tick = tick, .seconds = static_cast<double>(tick) / 100});
        publication->send(0, measured);
        ros::Odometry message;
        REQUIRE(read_cdr(reader->take().at(0).bytes, {.header = true}, message));
        return message.twist.twist;
    };
    const Velocity2D measured{.vx = 0.1, .va = 0.5};
    CHECK(sent({}, 0, &measured).linear.x == 0.1);
    CHECK(sent({}, 1, &measured).angular.z == 0.5);
    CHECK(sent({{1, 1}, 3.1}, 2, nullptr).linear.x == 0);  // the first one says nothing of a velocity
    // 0.1 s later, half a turn around it is 0.1 m nearer.
    const ros::Twist twist = sent({{0.9, 1}, -3.1}, 12, nullptr);
    CHECK(twist.linear.x == Approx(1).epsilon(0.01));
    CHECK(twist.linear.y == Approx(0).margin(0.01));
    CHECK(twist.angular.z == Approx((2 * M_PI - 6.2) / 0.1));
}

TEST_CASE("a range of Humble, without variance, is accepted", "[dds][ros]") {
    const auto mapping = ros::find_mapping(message_of<RangeData>(), "sensor_msgs/msg/Range", true);
    REQUIRE(mapping.has_value());
    FakeDomain domain;
    const auto place = domain.join();
    const dds::Topic topic = ros::topic_of("/ir", *mapping, true);
    const auto subscription = mapping->subscribe(place->read(topic));
    const auto writer = place->write(topic);
    ros::Range range;
    range.range = 0.5;
    Octets bytes = bytes_of(range);
    bytes.resize(bytes.size() - 4);
    writer->write(bytes);
    RangeData taken;
    CHECK(subscription->receive(1, [&](Value value) { taken = std::move(value).get<RangeData>(); }).empty());
    CHECK(taken.ranges == std::vector<double>{0.5});
}

TEST_CASE("an impossible topic of a node is refused with its name", "[dds][ros]") {
    RosTopic topic{"part.sped", "/a"};
    topic.place = {"s.lua", 3, 5};
    CHECK(NodeRig(spec_of({topic}, {})).refusal ==
          "s.lua:3:5: ros: part.sped: part has no port 'sped' (did you mean 'speed'?)");
    CHECK(NodeRig(spec_of({{"part.target", "/a"}}, {})).refusal == "ros: part.target: an in-port can't be published");
    CHECK(NodeRig(spec_of({}, {{"part.speed", "/a"}})).refusal ==
          "ros: /a: an out-port can't receive messages from a topic");
    CHECK(NodeRig(spec_of({{"part.speed", "/a"}, {"part.count", "/a"}}, {})).refusal ==
          "ros: part.count: the topic /a exists already");
}

TEST_CASE("an emergency stop sends zero to robots of ROS in every tick, until rearm", "[dds][ros][stop]") {
    CommandRig rig;
    REQUIRE(perform(rig.system, Stop{}, {Actor::Kind::console}));
    CHECK(rig.log.back() == "emergency stop: ros/mouse.cmd_vel gets speed 0 until rearm()");
    rig.go();
    CHECK(speeds(*rig.robot) == std::vector<double>{0});
    rig.tick();
    CHECK(speeds(*rig.robot) == std::vector<double>{0});
    REQUIRE(perform(rig.system, Rearm{}, {Actor::Kind::console}));
    rig.tick();
    CHECK(speeds(*rig.robot).empty());
    rig.go();
    CHECK(speeds(*rig.robot) == std::vector<double>{0.5});
}

TEST_CASE("zero is sent once to a robot of ROS when its port becomes silent", "[dds][ros][stop]") {
    CommandRig rig;
    rig.clock += 0.4;
    rig.node().between_ticks();
    CHECK(speeds(*rig.robot).empty());
    rig.clock += 0.2;
    rig.node().between_ticks();
    rig.node().between_ticks();
    CHECK(speeds(*rig.robot) == std::vector<double>{0});
}

TEST_CASE("zero is sent to a robot of ROS when the run ends", "[dds][ros][stop]") {
    CommandRig rig;
    rig.system.stop(1);
    CHECK(speeds(*rig.robot) == std::vector<double>{0});
}
