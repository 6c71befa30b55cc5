// Every type of ROS 2 that ports become, byte for byte as tests/golden/ros_messages has it.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "bindings/dds/ros/mapping.hpp"
#include "engine/ports/port.hpp"
#include "tests/unit/dds/fake_domain.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using dds::FakeDomain;

namespace {

// "RangeData sensor_msgs/msg/LaserScan": bytes.
std::map<std::string, Octets> golden_messages() {
    std::ifstream file(source_root() + "/tests/golden/ros_messages");
    std::map<std::string, Octets> all;
    Octets* bytes = nullptr;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#' || line.find('{') != line.npos) continue;
        if (line.front() != ' ') {
            bytes = &all[line];
            continue;
        }
        for (std::size_t i = line.find_first_not_of(' '); i + 1 < line.size(); i += 2)
            bytes->push_back(static_cast<std::uint8_t>(std::stoi(line.substr(i, 2), nullptr, 16)));
    }
    return all;
}

// What those messages are here.
Value value_of(const MessageType* type, std::string_view ros) {
    const RangerConfig range{.angularRes = 0.5, .minRange = 0.125, .maxRange = 4};
    const std::map<const MessageType*, Value> values{
        {message_of<Velocity2D>(), Velocity2D{0.25, -0.5, 1.5}},
        {message_of<Pose2D>(), Pose2D{{1.5, -2.25}, 0.5}},
        {message_of<Pose3D>(), Pose3D{{1.5, -2.25, 0.5}, {0.1, -0.2, 0.3}}},
        {message_of<CameraIntrinsics>(),
         CameraIntrinsics{640, 480, 500.5, 501.5, 320.25, 240.75, 0.125, -0.25, 0.5, -0.75, 0.0625}},
        {message_of<bool>(), true},
        {message_of<std::int16_t>(), std::int16_t{-12345}},
        {message_of<std::int32_t>(), std::int32_t{-123456789}},
        {message_of<float>(), -0.15625F},
        {message_of<double>(), 3.141592653589793},
        {message_of<std::string>(), std::string("a mouse")},
        {message_of<std::vector<std::int16_t>>(), std::vector<std::int16_t>{1, -2, 32767}},
        {message_of<std::vector<std::int32_t>>(), std::vector<std::int32_t>{1, -2, 2147483647}},
        {message_of<std::vector<double>>(), std::vector<double>{0.5, -0.25}},
        {message_of<std::vector<bool>>(), std::vector<bool>{true, false, true}},
    };
    if (ros == "sensor_msgs/msg/LaserScan") {
        RangerConfig scan = range;
        scan.minAngle = -0.5;
        scan.maxAngle = 0.5;
        scan.frequency = 8;
        return RangeData{.ranges = {0.5, 0.75, INFINITY}, .config = scan};
    }
    if (ros == "sensor_msgs/msg/Range") return RangeData{.ranges = {0.75}, .config = range};
    if (ros == "sensor_msgs/msg/Image") return CameraImage{2, 1, 24, "rgb8", 0, {1, 2, 3, 253, 254, 255}};
    if (ros == "sensor_msgs/msg/CompressedImage")
        return CameraImage{.format = "jpeg", .pixels = {0xff, 0xd8, 0xff, 0xd9, 0}};
    if (ros == "std_msgs/msg/Float32MultiArray") return std::vector<float>{0.5F, -0.25F};
    if (ros == "sensor_msgs/msg/Joy" && type == message_of<std::vector<float>>()) return std::vector<float>{0.5F, -1};
    return values.at(type);
}

// Angles are taken out of quaternions.
bool is_same(const Value& a, const Value& b) {
    if (const auto* pose = a.get_if<Pose2D>()) {
        const auto& other = b.get<Pose2D>();
        return pose->position == other.position && pose->heading == Approx(other.heading);
    }
    if (const auto* pose = a.get_if<Pose3D>()) {
        const auto& [position, orientation] = b.get<Pose3D>();
        return pose->position == position && pose->orientation.r == Approx(orientation.r) &&
               pose->orientation.p == Approx(orientation.p) && pose->orientation.y == Approx(orientation.y);
    }
    return a == b;
}

}  // namespace

TEST_CASE("each type of ROS is encoded and decoded as in its definition", "[dds][ros]") {
    const auto golden = golden_messages();
    for (const ros::Mapping& mapping : ros::mappings()) {
        const auto message = golden.find(fmt::format("{} {}", mapping.port_type->name, mapping.type));
        CAPTURE(mapping.type, mapping.port_type->name);
        REQUIRE(message != golden.end());
        const Value value = value_of(mapping.port_type, mapping.type);
        FakeDomain domain;
        const auto here = domain.join(), there = domain.join();
        const dds::Topic topic = ros::topic_of("/it", mapping, true);

        const auto reader = there->read(topic);
        const auto port = make_in_port(mapping.port_type, "it", "", 0);
        const auto publication = mapping.publish(*port, here->write(topic), std::string(mapping.frame));
        port->inject(value);
        port->latch({.tick = 125, .seconds = 1.25});
        publication->send(0, nullptr);
        const auto samples = reader->take();
        REQUIRE(samples.size() == 1);
        CHECK(samples[0].bytes == message->second);

        if (mapping.subscribe == nullptr) continue;
        const auto subscription = mapping.subscribe(here->read(topic));
        there->write(topic)->write(message->second);
        std::vector<Value> taken;
        CHECK(subscription->receive(0, [&](Value each) { taken.push_back(std::move(each)); }).empty());
        REQUIRE(taken.size() == 1);
        CHECK(is_same(taken[0], value));
    }
}
