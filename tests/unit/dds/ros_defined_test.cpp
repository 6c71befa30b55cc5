// Topics of ROS with types that files define.
#include <catch2/catch.hpp>
#include <string>

#include "bindings/dds/ros/mapping.hpp"
#include "bindings/dds/ros/type_hash.hpp"
#include "engine/values/view.hpp"
#include "tests/unit/dds/defined_types.hpp"
#include "tests/unit/dds/node_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

const MessageType* obstacle_type() {
    const MessageType* corner = define(definition_of("Corner", "float32 x\nfloat32 y\n"));
    return define(
        definition_of("Obstacle",
                      "float64 distance # [m]\nstring label\nCorner[] corners\nuint8[3] colour\nint64 count\n"),
        corner->payload);
}

// What a program of ROS has in its generated types.
struct RosCorner {
    static constexpr std::string_view type_name = "my_msgs/msg/Corner";
    float x, y;
};
struct RosObstacle {
    static constexpr std::string_view type_name = "my_msgs/msg/Obstacle";
    double distance;
    std::string label;
    std::vector<RosCorner> corners;
    std::array<std::uint8_t, 3> colour;
    std::int64_t count;
};

struct DefinedRig : NodeRigOf<Carrier> {
    DefinedRig(const RosSpec& spec, const MessageType* type)
        : NodeRigOf(spec, std::make_unique<Carrier>("part", type)) {}
};

const RosObstacle sent{.distance = 0.5, .label = "box", .corners = {{1, 2}, {3, 4}}, .colour = {9, 8, 7}, .count = -5};

}  // namespace

TEST_CASE("a type that a file defines goes to ROS and comes from it, under the name that the file gives it",
          "[dds][ros][messages]") {
    const MessageType* type = obstacle_type();
    CHECK(type->ros == "my_msgs/msg/Obstacle");
    DefinedRig rig(spec_of({{"part.seen", "/seen"}}, {{"part.given", "/given"}}), type);
    REQUIRE(rig.refusal.empty());
    const std::string dds_type = "my_msgs::msg::dds_::Obstacle_";
    const dds::Topic given = ros::topic_of("/given", *ros::find_mapping(type, "", true), true);
    CHECK(given.type == dds_type);
    const auto reader = rig.other->read(ros::topic_of("/seen", *ros::find_mapping(type, "", false), false));
    const auto writer = rig.other->write(given);
    rig.tick();
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        Octets bytes;
        write_cdr(bytes, {.order = order, .header = true}, sent);
        REQUIRE(writer->write(bytes));
        rig.tick();
        rig.tick();
        REQUIRE(rig.part->given().is_new());
        const Value got = rig.part->given().take().data;
        rig.part->seen().write(got);
        rig.tick();
        rig.tick();
        const auto samples = reader->take();
        REQUIRE(samples.size() == 1);
        RosObstacle back{};
        REQUIRE(read_cdr(samples[0].bytes, {.header = true}, back));
        CHECK(back.distance == 0.5);
        CHECK(back.label == "box");
        REQUIRE(back.corners.size() == 2);
        CHECK(back.corners[1].y == 4);
        CHECK(back.colour == sent.colour);
        CHECK(back.count == -5);
    }
    CHECK(rig.log.empty());
}

TEST_CASE("the hash of a type that a file defines is that of the same type generated for ROS", "[dds][ros][messages]") {
    CHECK(ros::type_hash(*obstacle_type()->payload) == ros::type_hash(type_of<RosObstacle>()));
    const std::string bounded = "string<=4 name\nint32[<=3] few\n";
    const MessageType* type = define(definition_of("Bounded", bounded));
    const MessageType* plain = define(definition_of("Bounded", "string name\nint32[] few\n"));
    CHECK(ros::type_hash(*type->payload) != ros::type_hash(*plain->payload));
}

TEST_CASE("a message of ROS that does not keep to its definition is rejected with the field", "[dds][ros][messages]") {
    const MessageType* type = define(definition_of("Few", "int32[<=2] few\n"));
    DefinedRig rig(spec_of({}, {{"part.given", "/given"}}), type);
    const auto writer = rig.other->write(ros::topic_of("/given", *ros::find_mapping(type, "", true), true));
    rig.tick();
    Octets bytes;
    write_cdr(bytes, {.header = true}, std::vector<std::int32_t>{1, 2, 3});
    REQUIRE(writer->write(bytes));
    rig.tick();
    CHECK_FALSE(rig.part->given().is_new());
    REQUIRE(rig.log.size() == 1);
    CHECK(rig.log[0] == "a message was rejected: field 'few' expected at most 2 elements, got 3");
}

TEST_CASE("a type without a name in ROS is refused with what to write", "[dds][ros][messages]") {
    MessageDefinition definition = definition_of("Nameless", "int32 number\n");
    definition.ros.clear();
    DefinedRig rig(spec_of({{"part.seen", "/seen"}}, {}), define(definition));
    CHECK(rig.refusal ==
          "ros: part.seen: my_msgs/Nameless has no name in ROS: write ros = \"PACKAGE/msg/NAME\" in Nameless.msg");
    DefinedRig other(spec_of({{"part.seen", "/seen", "my_msgs/msg/Corner"}}, {}), obstacle_type());
    CHECK(other.refusal ==
          "ros: part.seen: my_msgs/Obstacle can't be sent as 'my_msgs/msg/Corner'; the possible type is "
          "my_msgs/msg/Obstacle");
}
