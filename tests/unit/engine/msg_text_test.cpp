// Definitions of ROS that recordings contain.
#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "engine/messages/message_coding.hpp"
#include "engine/messages/msg_text.hpp"
#include "engine/ports/payload.hpp"

using namespace nezumi;

TEST_CASE("a message type is written as a definition of ROS, each structure in it once", "[messages][msg_text]") {
    const std::string line(80, '=');
    CHECK(msg_text(type_of<Pose2D>()) == "nezumi_msgs/Point2D position\nfloat64 heading\n" + line +
                                             "\nMSG: nezumi_msgs/Point2D\nfloat64 x\nfloat64 y\n");
    const MessageCoding own = own_coding(*message_of<std::vector<std::int16_t>>());
    CHECK(own.type == "nezumi_msgs/msg/TimedShortSeq");
    CHECK(own.definition ==
          "nezumi_msgs/Time tm\nint16[] data\n" + line + "\nMSG: nezumi_msgs/Time\nuint32 sec\nuint32 nsec\n");
}

TEST_CASE("messages of a type that ROS does not know are read again as they were written", "[messages][msg_text]") {
    const MessageCoding own = own_coding(*message_of<std::vector<SeenMarker>>());
    const std::vector<SeenMarker> seen{{.id = 7, .pose = {.position = {0.1, 0.2, 0.3}}}};
    Octets bytes;
    own.write(bytes, seen, 1.25);
    const auto read = own.read(bytes, 0);
    REQUIRE(read);
    CHECK(read->tm == 1.25);
    CHECK(read->data == Value(seen));
    bytes.resize(bytes.size() - 4);
    CHECK_FALSE(own.read(bytes, 0));
}
