// The types of ROS in which recordings have the messages of ports.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "bindings/dds/ros/mapping.hpp"
#include "engine/messages/message_coding.hpp"
#include "engine/ports/payload.hpp"
#include "tests/unit/dds/defined_types.hpp"

using namespace nezumi;

namespace {

AnyMessage there_and_back(const MessageType& type, const Value& value, double tm) {
    const auto coding = ros::find_coding(type);
    REQUIRE(coding);
    Octets bytes;
    coding->write(bytes, value, tm);
    auto read = coding->read(bytes, 99);
    REQUIRE(read);
    return std::move(*read);
}

}  // namespace

TEST_CASE("a recording has a port's messages in the first type of ROS with a stamp, and gives them back",
          "[dds][ros][record]") {
    CHECK(ros::find_coding(*message_of<Velocity2D>())->type == "geometry_msgs/msg/TwistStamped");
    const AnyMessage velocity = there_and_back(*message_of<Velocity2D>(), Velocity2D{0.1, 0, -2}, 1.25);
    CHECK(velocity.data == Value(Velocity2D{0.1, 0, -2}));
    CHECK(velocity.tm == 1.25);
    CHECK(ros::find_coding(*message_of<Pose2D>())->type == "nav_msgs/msg/Odometry");
    const Pose2D pose = there_and_back(*message_of<Pose2D>(), Pose2D{{1, 2}, 0.5}, 1).data.get<Pose2D>();
    CHECK(pose.position == Point2D{1, 2});
    CHECK(pose.heading == Approx(0.5).epsilon(1e-15));
    // A type without a stamp has the one of the recording.
    const std::vector<std::int16_t> distances{29, 16};
    const AnyMessage ranges = there_and_back(*message_of<std::vector<std::int16_t>>(), distances, 1.25);
    CHECK(ranges.data == Value(distances));
    CHECK(ranges.tm == 99);
}

TEST_CASE("another type of ROS is used where a recording says so", "[dds][ros][record]") {
    const auto twist = ros::find_coding(*message_of<Velocity2D>(), "geometry_msgs/msg/Twist");
    REQUIRE(twist);
    CHECK(twist->definition.starts_with("geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"));
    CHECK_FALSE(ros::find_coding(*message_of<Velocity2D>(), "geometry_msgs/msg/Wrench"));
    CHECK_FALSE(ros::find_coding(*message_of<std::vector<SeenMarker>>()));
}

TEST_CASE("a type that a file defines is recorded under its name in ROS", "[dds][ros][record][messages]") {
    const MessageType* type = define(definition_of("Seen", "float64 distance\nstring label\n"));
    const auto coding = ros::find_coding(*type);
    REQUIRE(coding);
    CHECK(coding->type == "my_msgs/msg/Seen");
    CHECK(coding->definition == "float64 distance\nstring label\n");
}
