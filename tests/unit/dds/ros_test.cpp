// Messages of ROS 2: types, names, bytes, conversions.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "bindings/dds/network_maker.hpp"
#include "bindings/dds/ros/convert.hpp"
#include "bindings/dds/ros/mapping.hpp"
#include "bindings/dds/ros/type_hash.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/dds/node_rig.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using dds::bytes_of;

namespace {

std::string hex(const Octets& data) {
    std::string text;
    for (const std::uint8_t byte : data) text += fmt::format("{:02x} ", byte);
    if (!text.empty()) text.pop_back();
    return text;
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

// The documentation's table.
std::string mapping_table() {
    std::string text = "| port | topic | ways | frame | QoS |\n|---|---|---|---|---|\n";
    for (const ros::Mapping& each : ros::mappings()) {
        text += fmt::format("| {} | `{}` | {} | {} | {} |\n", each.port_type->name, each.type,
                            each.subscribe != nullptr ? "both" : "to ROS",
                            each.frame.empty() ? "" : fmt::format("`{}`", each.frame),
                            each.sensor_data ? "best effort" : "reliable");
    }
    return text;
}

}  // namespace

TEST_CASE("the hashes of types are those that ROS 2 publishes", "[dds][ros]") {
    CHECK(ros::type_hash(type_of<ros::String>()) ==
          "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
    CHECK(ros::type_hash(type_of<ros::Twist>()) ==
          "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
    CHECK(ros::type_hash(type_of<ros::Odometry>()) ==
          "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
    CHECK(ros::type_hash(type_of<ros::Image>()) ==
          "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47");
    CHECK(ros::type_hash(type_of<ros::LaserScan>()) ==
          "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828");
    CHECK(ros::type_hash(type_of<ros::Range>()) ==
          "RIHS01_b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a");
    CHECK(ros::type_hash(type_of<ros::Float32>()) ==
          "RIHS01_7170d3d8f841f7be3172ce5f4f59f3a4d7f63b0447e8b33327601ad64d83d6e2");
}

TEST_CASE("topics and types have ROS 2's names on the wire", "[dds][ros]") {
    const auto twist = ros::find_mapping(message_of<Velocity2D>(), "", false);
    REQUIRE(twist.has_value());
    const dds::Topic written = ros::topic_of("/cmd_vel", *twist, true);
    CHECK(written.name == "rt/cmd_vel");
    CHECK(written.type == "geometry_msgs::msg::dds_::Twist_");
    CHECK(written.reliable);
    CHECK(written.user_data.starts_with("typehash=RIHS01_"));
    CHECK(written.user_data.back() == ';');
    const dds::Topic read = ros::topic_of("/cmd_vel", *twist, false);
    CHECK_FALSE(read.reliable);
    CHECK(read.depth == 1);
    const auto scan = ros::find_mapping(message_of<RangeData>(), "sensor_msgs/msg/LaserScan", false);
    REQUIRE(scan.has_value());
    CHECK_FALSE(ros::topic_of("/scan", *scan, true).reliable);
}

TEST_CASE("an impossible type for a port is refused with the possible ones", "[dds][ros]") {
    CHECK(ros::find_mapping(message_of<Velocity2D>(), "geometry_msgs/msg/Twst", false).error().message ==
          "TimedVelocity2D can't be sent as 'geometry_msgs/msg/Twst' (did you mean 'geometry_msgs/msg/Twist'?); the "
          "possible types are geometry_msgs/msg/Twist, geometry_msgs/msg/TwistStamped");
    CHECK(ros::find_mapping(message_of<std::vector<std::string>>(), "", false).error().message ==
          "there is no type of ROS for TimedStringSeq");
    CHECK(ros::find_mapping(message_of<Pose2D>(), "tf2_msgs/msg/TFMessage", true)
              .error()
              .message.find("TimedPose2D can't be made from 'tf2_msgs/msg/TFMessage'") == 0);
}

TEST_CASE("a stamped message is encoded as in ROS's definition", "[dds][ros]") {
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

TEST_CASE("conversion to ROS and back gives the same message", "[dds][ros]") {
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

TEST_CASE("distances are infinite where nothing is within reach, as REP 117 has it, both ways", "[dds][ros]") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    RangeData range;
    range.config = {.minRange = 0.125, .maxRange = 2};
    range.ranges = {2, 1, 0.0625, 3, std::nan("")};
    ros::LaserScan scan;
    ros::to_ros(range, scan);
    CHECK(std::vector<double>(scan.ranges.begin(), scan.ranges.begin() + 4) ==
          std::vector<double>{infinite, 1, -infinite, infinite});
    CHECK(std::isnan(scan.ranges[4]));
    RangeData back;
    REQUIRE(ros::from_ros(scan, back));
    CHECK(std::vector<double>(back.ranges.begin(), back.ranges.begin() + 4) ==
          std::vector<double>{infinite, 1, -infinite, infinite});
    CHECK(std::isnan(back.ranges[4]));
    ros::Range message;
    ros::to_ros(range, message);
    CHECK(message.range == infinite);
    message.range = std::numeric_limits<float>::quiet_NaN();
    REQUIRE(ros::from_ros(message, range));
    CHECK(std::isnan(range.ranges.at(0)));  // no obstacle at 0 m
    ros::to_ros(RangeData{}, message);
    CHECK(std::isnan(message.range));
}

TEST_CASE("a lens of ROS's rational model keeps its eight coefficients", "[dds][ros]") {
    const CameraIntrinsics intrinsics{640, 480, 500, 501, 320, 240, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    ros::CameraInfo message;
    ros::to_ros(intrinsics, message);
    CHECK(message.distortion_model == "rational_polynomial");
    CHECK(message.d == std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8});
    CHECK(around<ros::CameraInfo>(intrinsics) == intrinsics);
    message.distortion_model = "equidistant";
    CameraIntrinsics ours;
    CHECK(ros::from_ros(message, ours).error().message ==
          "the distortion model 'equidistant': expected plumb_bob or rational_polynomial");
}

TEST_CASE("pictures of ROS's cameras come with the encoding that detectors know", "[dds][ros]") {
    const auto taken = [](const char* encoding, std::uint32_t step, Octets data) {
        CameraImage ours;
        const auto ok = ros::from_ros(
            ros::Image{.height = 1, .width = 2, .encoding = encoding, .is_bigendian = 1, .step = step, .data = data},
            ours);
        INFO((ok ? std::string() : ok.error().message));
        REQUIRE(ok.has_value());
        return ours;
    };
    for (const auto& [theirs, format, bits] :
         std::vector<std::tuple<const char*, const char*, int>>{{"bgr8", "bgr8", 24},
                                                                {"8UC3", "bgr8", 24},
                                                                {"bgra8", "bgra8", 32},
                                                                {"rgba8", "rgba8", 32},
                                                                {"yuv422_yuy2", "yuv422_yuy2", 16},
                                                                {"mono16", "mono16", 16}}) {
        const CameraImage ours = taken(theirs, static_cast<std::uint32_t>(bits / 4), Octets(bits / 4, 7));
        CHECK(ours.format == format);
        CHECK(ours.bpp == bits);
    }
    CHECK(taken("mono16", 4, {1, 2, 3, 4}).pixels == Octets{2, 1, 4, 3});  // ours are little-endian
}

TEST_CASE("a picture of another encoding is refused", "[dds][ros]") {
    ros::Image image;
    image.encoding = "bayer_rggb8";
    CameraImage ours;
    CHECK(
        ros::from_ros(image, ours).error().message ==
        "a picture of encoding 'bayer_rggb8': expected rgb8, bgr8, rgba8, bgra8, mono8, mono16, yuv422_yuy2 or yuv422");
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

TEST_CASE("the documentation's table of ROS types is up to date", "[dds][ros]") {
    std::ifstream page(source_root() + "/docs/network.md");
    std::ostringstream text;
    text << page.rdbuf();
    INFO(mapping_table());
    CHECK(text.str().find(mapping_table()) != std::string::npos);
}
