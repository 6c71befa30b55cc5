// Connections that RTCs and tools make: the system has them, as if they were made at its console.
#include <catch2/catch.hpp>
#include <string>
#include <variant>
#include <vector>

#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;

namespace {

using Lines = std::vector<std::string>;

Lines peers(WireRig& rig, const std::string& port) {
    const auto node = rig.live->tree().find(port + ":peers");
    REQUIRE(node.has_value());
    const auto value = node->value();
    REQUIRE(value.has_value());
    return std::get<Value>(*value).get<Lines>();
}

Lines connections(const WireRig& rig) {
    Lines all;
    for (const ConnectionSpec& each : rig.live->system().connections()) all.push_back(each.from + " > " + each.to);
    return all;
}

}  // namespace

TEST_CASE("a connection made by an RTC or a tool is one of the system", "[openrtm][tools][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    CHECK(peers(rig, "relay.out").empty());
    REQUIRE(rig.answer(*in, "connect relay0 out", "connected ") == "connected 0");
    REQUIRE(rig.tells_line("connected by an RTC or a tool: relay.out to rtm:In0.in"));
    CHECK(peers(rig, "relay.out") == Lines{"rtm:In0.in"});
    REQUIRE(rig.live->system().foreign_connections().size() == 1);  // so `save` keeps it
    rig.publish(std::int32_t{7});
    rig.turn();
    CHECK(payload_of(rig.hears(*in, "got "), message_of<std::int32_t>(), std::endian::little) ==
          Value(std::int32_t{7}));
    // It is not made twice, and what ends it there ends it here.
    CHECK(rig.answer(*in, "profiles relay0 out", "profiles") == "profiles made by the fake");
    CHECK(rig.answer(*in, "disconnect", "disconnected ") == "disconnected 0");
    REQUIRE(rig.tells("disconnected by an RTC or a tool: relay.out to rtm:In0.in"));
    CHECK(peers(rig, "relay.out").empty());
    CHECK(rig.answer(*in, "profiles relay0 out", "profiles") == "profiles");
}

TEST_CASE("the console ends a connection that a tool has made", "[openrtm][tools][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.answer(*out, "connect relay0 in dataflow_type=push", "connected ") == "connected 0");
    REQUIRE(rig.tells_line("connected by an RTC or a tool: rtm:Out0.out to relay.in"));
    REQUIRE(rig.live->act(Disconnect{"rtm:Out0.out", "relay.in"}, {Actor::Kind::console}));
    CHECK_FALSE(rig.hears(*out, "left ").empty());
    CHECK(rig.answer(*out, "profiles relay0 in", "profiles") == "profiles");
}

TEST_CASE("a tool's connection ends with its RTC, and is not made again", "[openrtm][tools][wallclock]") {
    WireRig rig;
    auto in = rig.rtc("In0", "in", "TimedLong", "in");
    REQUIRE(rig.answer(*in, "connect relay0 out", "connected ") == "connected 0");
    REQUIRE(rig.tells_line("connected by an RTC or a tool: relay.out to rtm:In0.in"));
    in->kill();
    CHECK(rig.tells("disconnected by an RTC or a tool: relay.out to rtm:In0.in"));
    CHECK(rig.live->system().foreign_connections().empty());
}

TEST_CASE("tools see, make and end connections between components of the system", "[openrtm][tools][wallclock]") {
    WireRig rig;
    const auto tool = rig.rtc("Tool0", "in", "TimedLong", "in");
    const auto profiles = [&](const std::string& port) { return rig.answer(*tool, "profiles " + port, "profiles"); };
    CHECK(profiles("relay0 out") == "profiles");
    REQUIRE(rig.live->act(Connect{"relay.out", "relay.in"}, {Actor::Kind::console}));
    CHECK(rig.until([&] { return profiles("relay0 out") == "profiles relay0.out_relay0.in"; }));
    CHECK(profiles("relay0 in") == "profiles relay0.out_relay0.in");
    CHECK(rig.answer(*tool, "unlink relay0 in", "unlinked ") == "unlinked 0");
    CHECK(connections(rig).empty());
    CHECK(profiles("relay0 out") == "profiles");

    CHECK(rig.answer(*tool, "link relay0 out relay0 in", "linked ") == "linked 0");
    CHECK(connections(rig) == Lines{"relay.out > relay.in"});
    CHECK(profiles("relay0 in") == "profiles made by a tool");
    CHECK(rig.answer(*tool, "link relay0 in relay0 out", "linked ") == "linked 5");  // PRECONDITION_NOT_MET
    CHECK(rig.answer(*tool, "link relay0 out mouse0 target_velocity_in", "linked ") == "linked 2");  // BAD_PARAMETER
    rig.publish(std::int32_t{7});
    CHECK(rig.until([&] { return rig.arrived() == Value(std::int32_t{7}); }));
    CHECK(rig.component("relay").find_in_port("in")->count() == 1);  // by the system alone
    REQUIRE(rig.live->act(Disconnect{"relay.out", "relay.in"}, {Actor::Kind::console}));
    CHECK(rig.until([&] { return profiles("relay0 in") == "profiles"; }));
}
