// `network` and `ros` in system files: what they take, and what they refuse.
#include <catch2/catch.hpp>

#include "bindings/lua/files/system_text.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::system_files;

TEST_CASE("network gives the name of the host", "[lua][system_file][network]") {
    const auto spec = system_of(
        "network { name = 'mouse_pi', domain = 7, interface = 'wlan0', peers = { '192.168.11.2' }, secret = 's.key' }");
    REQUIRE(spec.network.has_value());
    CHECK(spec.network->name == "mouse_pi");
    CHECK(spec.network->domain == 7);
    CHECK(spec.network->interface == "wlan0");
    CHECK(spec.network->peers == std::vector<std::string>{"192.168.11.2"});
    CHECK(spec.network->secret == "s.key");
    CHECK_FALSE(spec.network->open);
    CHECK_FALSE(spec.network->lockstep);
    CHECK(spec.network->place.line == 1);
    CHECK_FALSE(system_of("seed(1)").network.has_value());
}

TEST_CASE("a port of another host is named host/name.port", "[lua][system_file][network]") {
    const auto spec =
        system_of("network { name = 'a' } connect('ev3/vehicle.current_vel', 'mouse.target_velocity_in')");
    REQUIRE(spec.connections.size() == 1);
    CHECK(spec.connections[0].from == "ev3/vehicle.current_vel");
    CHECK(system_error("connect('ev3/vehicle.out', 'mouse.in')") ==
          "s.lua:1: connect: ev3/vehicle.out: a port of another host needs the word network { name = ... }");
    CHECK(system_error("network { name = 'a' }\nconnect('b/x.out', 'c/y.in')") ==
          "s.lua:2: connect: b/x.out: both ends are on other hosts: one of these connects them");
    CHECK(system_error("network { name = 'a' }\nconnect('a/x.out', 'y.in')") ==
          "s.lua:2: connect: a/x.out: this host is 'a' itself: write \"x.out\"");
    CHECK(system_error("network { name = 'a' }\nconnect('a/b/x.out', 'y.in')") ==
          "s.lua:2: connect: expected \"name.port\", got 'a/b/x.out'");
    CHECK(system_error("network { name = 'a' }\nconnect('/x.out', 'y.in')") ==
          "s.lua:2: connect: expected \"name.port\", got '/x.out'");
}

TEST_CASE("ros lists the topics of a system", "[lua][system_file][network]") {
    const auto spec = system_of(
        "ros { node = 'mouse', domain = 5,\n"
        "  publish = { ['mouse.current_velocity_out'] = '/velocity' },\n"
        "  subscribe = { ['/cmd_vel'] = { port = 'mouse.target_velocity_in', type = 'geometry_msgs/msg/TwistStamped' } "
        "} }");
    REQUIRE(spec.ros.has_value());
    CHECK(spec.ros->node == "mouse");
    CHECK(spec.ros->domain == 5);
    REQUIRE(spec.ros->publish.size() == 1);
    CHECK(spec.ros->publish[0].port == "mouse.current_velocity_out");
    CHECK(spec.ros->publish[0].topic == "/velocity");
    CHECK(spec.ros->publish[0].place.line == 2);
    REQUIRE(spec.ros->subscribe.size() == 1);
    CHECK(spec.ros->subscribe[0].port == "mouse.target_velocity_in");
    CHECK(spec.ros->subscribe[0].topic == "/cmd_vel");
    CHECK(spec.ros->subscribe[0].type == "geometry_msgs/msg/TwistStamped");
}

TEST_CASE("network and ros are written and read back", "[lua][system_text][network]") {
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
