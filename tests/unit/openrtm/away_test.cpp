// RTCs that come late, hang, are killed; a name service that is away.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;

namespace {

constexpr std::int32_t seven = 7;

bool gets(WireRig& rig, Peer& out, std::int32_t number) {
    out.say("send " + hex_of(number, std::endian::little));
    return rig.until([&] { return rig.arrived() == Value(number); });
}

}  // namespace

TEST_CASE("a connection waits for its RTC, and is made again when that was killed", "[openrtm][away][wallclock]") {
    WireRig rig("TimedLong", "connect(\"rtm:Out0.out\", \"relay.in\")");
    CHECK(rig.tells("not connected: rtm:Out0.out to relay.in: there is no RTC 'Out0' in the name service"));
    auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    CHECK(rig.tells_line("connected: rtm:Out0.out to relay.in"));
    REQUIRE(rig.hears(*out, "joined ") == "joined Out0.out_relay.in");
    CHECK(gets(rig, *out, seven));
    rig.told = "\n";
    out->kill();
    CHECK(rig.tells(
        "not connected: rtm:Out0.out to relay.in: its entry in the name service is stale: the RTC was not found"));
    out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.hears(*out, "joined ") == "joined Out0.out_relay.in");
    CHECK(gets(rig, *out, seven + 1));
}

TEST_CASE("a connection that is made again at once is reported again", "[openrtm][away][wallclock]") {
    WireRig rig("TimedLong", "connect(\"rtm:Out0.out\", \"relay.in\")");
    auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.tells_line("connected: rtm:Out0.out to relay.in"));
    rig.told = "\n";
    out->kill();
    out = rig.rtc("Out0", "out", "TimedLong", "out");
    CHECK(rig.tells_line("connected: rtm:Out0.out to relay.in"));
}

TEST_CASE("a connection to an RTC carries what a port publishes", "[openrtm][away][wallclock]") {
    WireRig rig("TimedLong", "connect(\"relay.out\", \"rtm:In0.in\")");
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    REQUIRE(rig.hears(*in, "joined ") == "joined relay.out_In0.in");
    REQUIRE(rig.tells_line("connected: relay.out to rtm:In0.in"));  // here as well
    rig.publish(seven);
    rig.turn();
    CHECK(payload_of(rig.hears(*in, "got "), message_of<std::int32_t>(), std::endian::little) == Value(seven));
}

TEST_CASE("an RTC whose port does not fit is reported and not connected", "[openrtm][away][wallclock]") {
    WireRig rig("TimedLong",
                "connect(\"rtm:Other0.out\", \"relay.in\")\nconnect(\"rtm:In0.in\", \"relay.in\")\n"
                "connect(\"rtm:In0.inn\", \"relay.in\")");
    const auto other = rig.rtc("Other0", "out", "TimedDouble", "out");
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    CHECK(rig.tells("it carries TimedDouble, and relay.in carries TimedLong"));
    CHECK(rig.tells("not connected: rtm:In0.in to relay.in: both are in-ports"));
    CHECK(rig.tells("not connected: rtm:In0.inn to relay.in: the RTC has no port 'inn'"));
}

TEST_CASE("RTCs are registered again when the name service is back, and connections live meanwhile",
          "[openrtm][away][wallclock]") {
    WireRig rig("TimedLong", "connect(\"rtm:Out0.out\", \"relay.in\")");
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.hears(*out, "joined ") != "");
    static_cast<Names&>(rig).kill();
    CHECK(rig.tells("rtm: no name service answers at " + rig.address()));
    CHECK(gets(rig, *out, seven));
    rig.forget();
    rig.start();
    CHECK(rig.until([&] {
        const auto peer =
            std::make_unique<Peer>(std::vector<std::string>{fake_rtc(), rig.address(), "In0", "in", "TimedLong", "in"});
        peer->say("state relay0");
        return peer->heard(
                   "state ", [&] { rig.turn(); }, 1) == "state 2";
    }));
}

TEST_CASE("an RTC that hangs delays no tick and no other RTC", "[openrtm][away][wallclock]") {
    WireRig rig;
    const auto hangs = rig.rtc("In0", "in", "TimedLong", "in");
    const auto works = rig.rtc("In1", "in", "TimedLong", "in");
    REQUIRE(rig.answer(*hangs, "connect relay0 out", "connected ") == "connected 0");
    REQUIRE(rig.answer(*works, "connect relay0 out", "connected ") == "connected 0");
    hangs->say("hang 3600");
    std::chrono::steady_clock::duration longest{};
    for (std::int32_t i = 1; i <= 200; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        rig.publish(i);
        rig.turn();
        longest = std::max(longest, std::chrono::steady_clock::now() - begin);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    // A call that a tick waited for would last a second.
    CHECK(longest < std::chrono::milliseconds(500));
    // All but the stamp.
    const std::string last = hex_of(std::int32_t{200}, std::endian::little).substr(16);
    CHECK(rig.until([&] { return works->text().find(last) != std::string::npos; }));
    const auto begin = std::chrono::steady_clock::now();
    rig.server.reset();
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(15));
}

TEST_CASE("a robot whose driver is killed stops", "[openrtm][away][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedVelocity2D", "out");
    REQUIRE(rig.answer(*out, "connect mouse0 target_velocity_in", "connected ") == "connected 0");
    const auto& mouse = *rig.live->system().find_robot("mouse");
    const std::string forward = "send " + hex_of(Velocity2D{.vx = 0.1}, std::endian::little);
    CHECK(rig.until([&] {
        out->say(forward);
        return mouse.guard().current().vx > 0.09;
    }));
    out->kill();
    CHECK(rig.until([&] { return mouse.guard().current() == Velocity2D{}; }));
}

TEST_CASE("a second system on a computer is another instance, and an ended one frees its name",
          "[openrtm][away][wallclock]") {
    WireRig rig;
    REQUIRE(rig.tells("relay is "));
    // Who has the name of a component that is exported later.
    auto other = rig.rtc("late0", "in", "TimedLong", "in");
    rig.folder.write("behaviors/late.lua", relay_behavior("TimedLong"));
    const std::string text =
        "behavior \"late\" { script = \"late\" }\nrtm { export = \"late\", nameserver = \"" + rig.address() + "\" }\n";
    rig.folder.write("system.lua", text);
    REQUIRE(rig.live->act(Restart{}, {Actor::Kind::console}));
    CHECK(rig.tells("late is "));
    CHECK(rig.told.find("late1.rtc") != std::string::npos);
}
