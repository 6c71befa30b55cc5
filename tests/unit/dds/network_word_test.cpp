// `network` and `ros` in system files: what they take, and what they refuse.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "bindings/lua/files/system_text.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::dds;
using namespace nezumi::system_files;

TEST_CASE("network gives the name of the host", "[dds][system_file][network]") {
    const auto spec = system_of(
        "network { name = 'mouse_pi', domain = 7, interface = 'wlan0', peers = { '192.168.11.2' }, secret = 's.key' }");
    const NetworkSpec* network = NetworkWord::find(spec);
    REQUIRE(network != nullptr);
    CHECK(network->name == "mouse_pi");
    CHECK(network->domain == 7);
    CHECK(network->interface == "wlan0");
    CHECK(network->peers == std::vector<std::string>{"192.168.11.2"});
    CHECK(network->secret == "s.key");
    CHECK_FALSE(network->open);
    CHECK_FALSE(network->lockstep);
    CHECK(network->place.line == 1);
    CHECK(system_of("seed(1)").peers.empty());
}

TEST_CASE("a port of another host is named host/name.port", "[dds][system_file][network]") {
    const auto spec =
        system_of("network { name = 'a' } connect('ev3/vehicle.current_vel', 'mouse.target_velocity_in')");
    REQUIRE(spec.connections.size() == 1);
    CHECK(spec.connections[0].from == "ev3/vehicle.current_vel");
    CHECK(system_error("connect('ev3/vehicle.out', 'mouse.in')") ==
          "s.lua:1: connect: ev3/vehicle.out: a port of another host needs network { name = ... } in the system file");
    CHECK(system_error("network { name = 'a' }\nconnect('b/x.out', 'c/y.in')") ==
          "s.lua:2: connect: b/x.out: both ports are on other hosts: connect them in the system file of one of these "
          "hosts");
    CHECK(system_error("network { name = 'a' }\nconnect('a/x.out', 'y.in')") ==
          "s.lua:2: connect: a/x.out: this host is 'a' itself: write \"x.out\"");
    CHECK(system_error("network { name = 'a' }\nconnect('a/b/x.out', 'y.in')") ==
          "s.lua:2: connect: expected \"name.port\", got 'a/b/x.out'");
    CHECK(system_error("network { name = 'a' }\nconnect('/x.out', 'y.in')") ==
          "s.lua:2: connect: expected \"name.port\", got '/x.out'");
}

TEST_CASE("ros lists the topics of a system", "[dds][system_file][network]") {
    const auto spec = system_of(
        "ros { node = 'mouse', domain = 5,\n"
        "  publish = { ['mouse.current_velocity_out'] = '/velocity' },\n"
        "  subscribe = { ['/cmd_vel'] = { port = 'mouse.target_velocity_in', type = 'geometry_msgs/msg/TwistStamped' } "
        "} }");
    const RosSpec* ros = RosWord::find(spec);
    REQUIRE(ros != nullptr);
    CHECK(ros->node == "mouse");
    CHECK(ros->domain == 5);
    REQUIRE(ros->publish.size() == 1);
    CHECK(ros->publish[0].port == "mouse.current_velocity_out");
    CHECK(ros->publish[0].topic == "/velocity");
    CHECK(ros->publish[0].place.line == 2);
    REQUIRE(ros->subscribe.size() == 1);
    CHECK(ros->subscribe[0].port == "mouse.target_velocity_in");
    CHECK(ros->subscribe[0].topic == "/cmd_vel");
    CHECK(ros->subscribe[0].type == "geometry_msgs/msg/TwistStamped");
}

TEST_CASE("network and ros are written and read back", "[dds][system_text][network]") {
    const std::string text =
        "network { name = \"a\", domain = 3, lockstep = true, peers = { \"10.0.0.1\", \"10.0.0.2\" }, hosts = { \"b\" "
        "} }\n"
        "ros {\n"
        "  node = \"n\",\n"
        "  publish = {\n"
        "    [\"a.b\"] = \"/c\",\n"
        "    [\"g.h\"] = { \"/odom\", { topic = \"/tf\", type = \"tf2_msgs/msg/TFMessage\" } },\n"
        "  },\n"
        "  subscribe = {\n"
        "    [\"/d\"] = { port = \"e.f\", type = \"sensor_msgs/msg/Joy\" },\n"
        "  },\n"
        "}\n";
    CHECK(write_system_text(system_of(text), "x") == "--- x\n" + text + "\n");
}

TEST_CASE("the default domain of a ROS node is that of the environment", "[dds][system_file][network]") {
    const auto domain_of = [](const std::string& said) {
        const auto spec = system_of("ros { node = 'n'" + said + " }");
        REQUIRE(RosWord::find(spec) != nullptr);
        return RosWord::find(spec)->domain;
    };
    setenv("ROS_DOMAIN_ID", "42", 1);
    CHECK(domain_of("") == 42);
    CHECK(domain_of(", domain = 0") == 0);
    setenv("ROS_DOMAIN_ID", "many", 1);
    CHECK(system_error("ros { node = 'n' }") ==
          "s.lua:1: ros: the environment's ROS_DOMAIN_ID: expected 0 to 232, got 'many'");
    unsetenv("ROS_DOMAIN_ID");
    CHECK(domain_of("") == 0);
}
