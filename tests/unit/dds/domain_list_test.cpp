// What `nezumi network list` says.
#include "bindings/dds/domain_list.hpp"

#include <catch2/catch.hpp>

using namespace nezumi;
using namespace nezumi::dds;

TEST_CASE("hosts and topics of ROS are listed with their usual names", "[dds]") {
    Announcement ev3;
    ev3.head = {.protocol = protocol, .host = "ev3", .version = "0.1.0"};
    ev3.ports.resize(1);
    const std::string twist = "geometry_msgs::msg::dds_::Twist_";
    CHECK(list_domain({&ev3}, {{"rt/cmd_vel", twist, true},
                               {"rt/cmd_vel", twist, false},
                               {"rt/cmd_vel", "std_msgs::msg::dds_::String_", false},
                               {"rt/own", twist, true, true, true},
                               {"nezumi/hosts", "nezumi::Announcement", true}}) ==
          "host ev3  nezumi 0.1.0, 1 port\n"
          "topic /cmd_vel  geometry_msgs/msg/Twist, std_msgs/msg/String  1 publisher, 2 subscribers\n");
    CHECK(list_domain({}, {}).empty());
}
