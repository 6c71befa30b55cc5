// The message types: names, fields, units, and the walks over them.
#include <catch2/catch.hpp>
#include <limits>

#include "engine/ports/payload.hpp"
#include "engine/ports/port.hpp"

using namespace nezumi;

namespace {

// "vx m/s, vy m/s" of a described structure.
template <class T>
std::string fields_of() {
    std::string text;
    for (const Type::Field& field : type_of<T>().fields)
        text += (text.empty() ? "" : ", ") + field.name + (field.unit.empty() ? "" : " " + field.unit);
    return text;
}

std::vector<std::string> leaves_of(const ValueView& value) {
    std::vector<std::string> paths;
    visit_leaves(value, [&](const LeafPath& path, const ValueView&) { paths.push_back(path.text()); });
    return paths;
}

}  // namespace

TEST_CASE("the message types are the eighteen of OpenRTM-aist, by their names, and three of our own",
          "[engine][message]") {
    const std::vector<std::string_view> expected{
        "TimedBoolean",     "TimedShort",      "TimedLong",    "TimedFloat",    "TimedDouble",    "TimedString",
        "TimedBooleanSeq",  "TimedShortSeq",   "TimedLongSeq", "TimedFloatSeq", "TimedDoubleSeq", "TimedStringSeq",
        "TimedOctetSeq",    "TimedVelocity2D", "TimedPose2D",  "TimedPose3D",   "RangeData",      "CameraImage",
        "CameraIntrinsics", "SeenMarkerSeq",   "NeighbourSeq"};
    CHECK(std::vector<std::string_view>(compiled_message_names().begin(), compiled_message_names().end()) == expected);
}

TEST_CASE("single values and sequences carry the width that their name says", "[engine][message]") {
    CHECK(message_of<bool>() == find_message_type("TimedBoolean"));
    CHECK(message_of<std::int16_t>() == find_message_type("TimedShort"));
    CHECK(message_of<std::int32_t>() == find_message_type("TimedLong"));
    CHECK(message_of<float>() == find_message_type("TimedFloat"));
    CHECK(message_of<double>() == find_message_type("TimedDouble"));
    CHECK(message_of<std::string>() == find_message_type("TimedString"));
    CHECK(message_of<std::vector<bool>>() == find_message_type("TimedBooleanSeq"));
    CHECK(message_of<std::vector<std::int16_t>>() == find_message_type("TimedShortSeq"));
    CHECK(message_of<std::vector<std::int32_t>>() == find_message_type("TimedLongSeq"));
    CHECK(message_of<std::vector<float>>() == find_message_type("TimedFloatSeq"));
    CHECK(message_of<std::vector<double>>() == find_message_type("TimedDoubleSeq"));
    CHECK(message_of<std::vector<std::string>>() == find_message_type("TimedStringSeq"));
    CHECK(message_of<Octets>() == find_message_type("TimedOctetSeq"));
}

TEST_CASE("every structure lists its fields in order, with units of the SI", "[engine][message]") {
    CHECK(fields_of<Velocity2D>() == "vx m/s, vy m/s, va rad/s");
    CHECK(fields_of<Pose2D>() == "position, heading rad");
    CHECK(fields_of<Point2D>() == "x m, y m");
    CHECK(fields_of<Pose3D>() == "position, orientation");
    CHECK(fields_of<Point3D>() == "x m, y m, z m");
    CHECK(fields_of<Orientation3D>() == "r rad, p rad, y rad");
    CHECK(fields_of<RangeData>() == "ranges m, geometry, config");
    CHECK(fields_of<RangerGeometry>() == "pose, size, elements");
    CHECK(fields_of<RangerElement>() == "pose, size");
    CHECK(fields_of<Size3D>() == "l m, w m, h m");
    CHECK(fields_of<RangerConfig>() ==
          "minAngle rad, maxAngle rad, angularRes rad, minRange m, maxRange m, rangeRes m, frequency Hz");
    CHECK(fields_of<SeenMarker>() == "id, pose");
    CHECK(fields_of<CameraImage>() == "width px, height px, bpp bit, format, fDiv, pixels");
}

TEST_CASE("for_each_field hands out the members themselves", "[engine][message]") {
    Velocity2D velocity;
    double next = 1;
    for_each_field(velocity, [&](const auto&, double& member) { member = next++; });
    CHECK(velocity == Velocity2D{.vx = 1, .vy = 2, .va = 3});
}

TEST_CASE("leaves are visited with their paths, and elements are counted from 1", "[engine][message]") {
    CHECK(leaves_of(std::int16_t{3}) == std::vector<std::string>{""});
    CHECK(leaves_of(Pose2D{}) == std::vector<std::string>{"position.x", "position.y", "heading"});
    CHECK(leaves_of(std::vector<bool>{true, false}) == std::vector<std::string>{"[1]", "[2]"});
    RangeData range;
    range.ranges = {0.1, 0.2};
    const auto paths = leaves_of(range);
    CHECK(paths[0] == "ranges[1]");
    CHECK(paths[1] == "ranges[2]");
    CHECK(paths.back() == "config.frequency");
    CHECK(leaves_of(std::vector<SeenMarker>{{.id = 7}}).front() == "[1].id");
    CHECK(leaves_of(std::vector<SeenMarker>{{.id = 7}, {.id = 8}}).back() == "[2].pose.orientation.y");
    CHECK(leaves_of(CameraImage{.pixels = {1, 2, 3}}).back() == "fDiv");
}

TEST_CASE("a payload with one number that is not finite is not finite", "[engine][message]") {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    CHECK(is_finite(Velocity2D{1, 2, 3}));
    CHECK(is_finite(std::vector<double>{}));
    CHECK(is_finite(std::string("nan")));
    CHECK(is_finite(std::vector<bool>{true}));
    for (const double value : bad) {
        CHECK_FALSE(is_finite(value));
        CHECK_FALSE(is_finite(static_cast<float>(value)));
        CHECK_FALSE(is_finite(std::vector<double>{0, value}));
        CHECK_FALSE(is_finite(std::vector<float>{static_cast<float>(value)}));
        CHECK_FALSE(is_finite(Velocity2D{.va = value}));
        CHECK_FALSE(is_finite(Pose2D{.position = {.y = value}}));
        CHECK(is_finite(RangeData{.ranges = {1, value}}));  // nothing within reach, too near, no reading
        CHECK_FALSE(is_finite(RangeData{.config = {.maxRange = value}}));
        RangeData deep;
        deep.geometry.elements.push_back({.pose = {.orientation = {.r = value}}});
        CHECK_FALSE(is_finite(deep));
        CHECK_FALSE(is_finite(CameraImage{.fDiv = value}));
        CHECK_FALSE(is_finite(std::vector<SeenMarker>{{}, {.pose = {.position = {.z = value}}}}));
    }
}

TEST_CASE("equal payloads mix equally, and every leaf counts", "[engine][message]") {
    CHECK(mix_payload(1, Velocity2D{1, 2, 3}) == mix_payload(1, Velocity2D{1, 2, 3}));
    CHECK(mix_payload(1, Velocity2D{1, 2, 3}) != mix_payload(2, Velocity2D{1, 2, 3}));
    CHECK(mix_payload(1, Velocity2D{1, 2, 3}) != mix_payload(1, Velocity2D{1, 3, 2}));
    CHECK(mix_payload(1, 0.0) == mix_payload(1, -0.0));
    CHECK(mix_payload(1, std::string("ab")) != mix_payload(1, std::string("ba")));
    CHECK(mix_payload(1, std::string("a")) != mix_payload(1, std::string("a\0", 2)));
    CHECK(mix_payload(1, std::vector<bool>{}) != mix_payload(1, std::vector<bool>{false}));
    CHECK(mix_payload(1, std::vector<std::string>{"ab", "c"}) != mix_payload(1, std::vector<std::string>{"a", "bc"}));
    CHECK(mix_payload(1, std::vector<SeenMarker>{{.id = 1}, {.id = 2}}) !=
          mix_payload(1, std::vector<SeenMarker>{{.id = 2}, {.id = 1}}));
    CHECK(mix_payload(1, Octets{1, 2}) != mix_payload(1, Octets{2, 1}));
    CHECK(mix_payload(1, std::vector<std::int16_t>{-1}) != mix_payload(1, std::vector<std::int16_t>{1}));
}

TEST_CASE("the error for an unknown message type suggests the nearest name", "[engine][message]") {
    const auto slip = find_message_type("TimedVelocity2d");
    REQUIRE_FALSE(slip);
    CHECK(slip.error().message ==
          "unknown type 'TimedVelocity2d' (did you mean 'TimedVelocity2D'?); `nezumi types` lists them all");
    CHECK(find_message_type("Joystick").error().message == "unknown type 'Joystick'; `nezumi types` lists them all");
}

TEST_CASE("a port of every type can be made by the type's name alone", "[engine][message][port]") {
    for (const MessageType& each : compiled_message_types()) {
        const MessageType* const type = &each;
        const auto in = make_in_port(type, "in", "doc", 0);
        const auto out = make_out_port(type, "out", "doc");
        INFO(type->name);
        CHECK(in->type_name() == type->name);
        CHECK(out->type() == type);
        CHECK(in->direction() == Direction::in);
        CHECK(out->direction() == Direction::out);
        CHECK(message_of(in->value().type()) == type);
        CHECK(in->value() == out->value());
        // Only a velocity is a command that is safe at zero.
        CHECK(out->has_safe() == (out->type_name() == "TimedVelocity2D"));
        in->connect(*out);
        out->write_any(out->value());
        CHECK(out->latch({0, 0}));
        in->latch({0, 0});
        CHECK(in->is_new());
    }
}
