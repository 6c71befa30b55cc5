// RTCs that are other programs, as a console asks for them: by name, at work, hanging, killed.
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>

#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;
using What = RtcRequest::What;

namespace {

std::string host() {
    std::array<char, 256> name{};
    REQUIRE(gethostname(name.data(), name.size() - 1) == 0);
    return name.data();
}

// The answer, while ticks go on.
std::string asked(WireRig& rig, PeerQuestion question) {
    auto answer = rig.server->ask(std::move(question));
    REQUIRE(rig.until([&] { return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
    const auto text = answer.get();
    return text ? *text : "! " + text.error().message;
}

std::string done(WireRig& rig, const std::string& name, RtcRequest request) {
    return asked(rig, {.name = name, .request = std::move(request)});
}

}  // namespace

TEST_CASE("a console lists the RTCs of the name service, those that are gone and those that hang",
          "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto works = rig.rtc("Works0", "out", "TimedLong", "out");
    const auto hangs = rig.rtc("Hangs0", "out", "TimedLong", "out");
    const auto killed = rig.rtc("Killed0", "out", "TimedLong", "out");
    hangs->halt();
    killed->kill();
    const std::string text = asked(rig, {});
    const std::string begin = "rtm:" + host() + ".host_cxt/";
    CHECK(text.find(begin + "Works0  Fake, INACTIVE\n  out out  TimedLong  not connected") != std::string::npos);
    CHECK(text.find(begin + "Hangs0  does not answer") != std::string::npos);
    CHECK(text.find(begin +
                    "Killed0  no longer exists: its program has crashed, and its name is still in the name service") !=
          std::string::npos);
    CHECK(text.find(begin + "relay0  Relay, ACTIVE\n  in  in   TimedLong  not connected\n") != std::string::npos);
}

TEST_CASE("a console activates, deactivates and resets an RTC", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto peer = rig.rtc("Peer0", "out", "TimedLong", "out");
    const std::string begin = "rtm:" + host() + ".host_cxt/Peer0  Fake, ";
    const std::string full = host() + ".host_cxt/Peer0";
    CHECK(done(rig, "Peer0", {.what = What::activate}) == begin + "ACTIVE");
    CHECK(rig.hears(*peer, "activated") == "activated");
    CHECK(done(rig, full, {.what = What::activate}) ==
          "! rtm:" + full + ": its state does not allow that (PRECONDITION_NOT_MET)");
    CHECK(done(rig, full, {.what = What::deactivate}) == begin + "INACTIVE");
    peer->say("fail");
    peer->say("fetch");
    CHECK(rig.until([&] { return asked(rig, {.name = "Peer0"}).find("ERROR") != std::string::npos; }));
    CHECK(done(rig, full, {.what = What::reset}) == begin + "INACTIVE");
    CHECK(done(rig, "Pear0", {.what = What::activate}) ==
          "! there is no RTC 'Pear0' in the name service (did you mean 'Peer0'?)");
}

TEST_CASE("a console says why the state of an RTC can't change yet", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto peer = rig.rtc("Peer0", "out", "TimedLong", "out");
    const std::string name = "rtm:" + host() + ".host_cxt/Peer0";
    REQUIRE(rig.answer(*peer, "stop Peer0", "done") == "done 0");
    CHECK(done(rig, "Peer0", {.what = What::activate}) ==
          "! " + name + ": its execution context is stopped: start that first (RTC_ERROR)");
    CHECK(asked(rig, {.name = "Peer0"}).starts_with(name + "  Fake, INACTIVE, its execution context is stopped\n"));
    REQUIRE(rig.answer(*peer, "start Peer0", "done") == "done 0");
    CHECK(asked(rig, {.name = "Peer0"}).starts_with(name + "  Fake, INACTIVE\n"));
    CHECK(done(rig, "Peer0", {.what = What::activate}) == name + "  Fake, ACTIVE");
    peer->say("busy");
    CHECK(rig.answer(*peer, "state Peer0", "state") == "state 2");
    CHECK(done(rig, "Peer0", {.what = What::deactivate}) ==
          "! " + name + ": its execution takes long, so it may follow later (RTC_ERROR)");
    peer->say("idle");
    CHECK(rig.hears(*peer, "deactivated") == "deactivated");
}

TEST_CASE("an RTC in ERROR has to be reset first", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto peer = rig.rtc("Peer0", "out", "TimedLong", "out");
    peer->say("fail");
    CHECK(rig.until([&] { return asked(rig, {.name = "Peer0"}).find("ERROR") != std::string::npos; }));
    CHECK(done(rig, "Peer0", {.what = What::activate}) ==
          "! rtm:" + host() + ".host_cxt/Peer0: it is in ERROR: reset it (PRECONDITION_NOT_MET)");
}

TEST_CASE("a console reads and sets the configuration of an RTC", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto peer = rig.rtc("Peer0", "out", "TimedLong", "out");
    const std::string begin = "rtm:" + host() + ".host_cxt/Peer0  Fake, ";
    const std::string fault = "! rtm:" + host() + ".host_cxt/Peer0: ";
    CHECK(asked(rig, {.name = "Peer0"}) ==
          begin + "INACTIVE\n  out out  TimedLong  not connected\n  config.speed = 0.5\n  other sets: fast");
    CHECK(done(rig, "Peer0", {.what = What::set, .values = {{"speed", "0.75"}}}) == begin + "INACTIVE");
    CHECK(rig.hears(*peer, "uses ") == "uses default speed=0.75");
    CHECK(asked(rig, {.name = "Peer0"}).find("config.speed = 0.75") != std::string::npos);
    CHECK(done(rig, "Peer0", {.what = What::use, .set = "fast"}) == begin + "INACTIVE");
    CHECK(rig.hears(*peer, "uses ") == "uses fast speed=1");
    CHECK(done(rig, "Peer0", {.what = What::use, .set = "fats"}) ==
          fault + "it has no configuration set 'fats' (did you mean 'fast'?)");
    CHECK(done(rig, "Peer0", {.what = What::set, .values = {{"sped", "1"}}}) ==
          fault + "it has no parameter 'sped' (did you mean 'speed'?)");
    CHECK(done(rig, "Peer0", {.what = What::set, .values = {{"speed", "-1"}}}) == fault + "it refuses these values");
}

TEST_CASE("a console ends an RTC, and removes the name of one that is gone", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto peer = rig.rtc("Peer0", "out", "TimedLong", "out");
    const auto killed = rig.rtc("Killed0", "out", "TimedLong", "out");
    CHECK(done(rig, "Peer0", {.what = What::exit}).empty());
    CHECK(rig.hears(*peer, "exits") == "exits");
    CHECK(done(rig, "Peer0", {.what = What::forget}) ==
          "! rtm:" + host() +
              ".host_cxt/Peer0: the RTC still runs, or hangs: only names of RTCs that have ended can be removed");
    killed->kill();
    CHECK(done(rig, "Killed0", {.what = What::forget}).empty());
    CHECK(done(rig, "Killed0", {.what = What::forget}).starts_with("! there is no RTC 'Killed0' in the name service"));
}

TEST_CASE("ports of two other RTCs are connected and disconnected", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    const auto ask = [&](What what, const std::string& to) {
        return asked(rig, {.request = RtcRequest{.what = what,
                                                 .component = "Out0_In0",
                                                 .values = {{"dataport.dataflow_type", "push"}},
                                                 .from = "Out0.out",
                                                 .to = to}});
    };
    CHECK(ask(What::connect, "In0.in").empty());
    CHECK(rig.answer(*out, "profiles In0 in", "profiles") == "profiles Out0_In0");
    CHECK(ask(What::connect, "In0.in").empty());  // it is so
    CHECK(rig.answer(*out, "profiles In0 in", "profiles") == "profiles Out0_In0");
    CHECK(ask(What::disconnect, "In0.in").empty());
    CHECK(rig.answer(*out, "profiles In0 in", "profiles") == "profiles");
    CHECK(ask(What::disconnect, "In0.in") == "! rtm:" + host() + ".host_cxt/Out0: they are not connected");
    CHECK(ask(What::connect, "In0.input") == "! rtm:" + host() + ".host_cxt/In0: it has no port 'input'");
    CHECK(ask(What::connect, "Inn0.in") == "! there is no RTC 'Inn0' in the name service (did you mean 'In0'?)");
}

TEST_CASE("a console shows that an RTC hangs or is gone, or that the name service is away",
          "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto hangs = rig.rtc("Hangs0", "out", "TimedLong", "out");
    const auto killed = rig.rtc("Killed0", "out", "TimedLong", "out");
    hangs->halt();
    killed->kill();
    CHECK(done(rig, "Hangs0", {.what = What::activate}) == "! 'Hangs0' does not answer");
    CHECK(done(rig, "Killed0", {.what = What::activate}) ==
          "! 'Killed0' was not found: its entry in the name service is stale");
    static_cast<Names&>(rig).kill();
    CHECK(asked(rig, {}) == "! no name service answers at " + rig.address() + ": start one, for example omniNames");
}

TEST_CASE("waiting questions are answered at the end of a run", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto hangs = rig.rtc("Hangs0", "out", "TimedLong", "out");
    hangs->halt();
    auto first = rig.server->ask({.name = "Hangs0"});
    auto second = rig.server->ask({.name = "Hangs0"});
    rig.server.reset();
    REQUIRE(first.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
    REQUIRE(second.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
    const auto answer = second.get();
    REQUIRE_FALSE(answer);
    CHECK(answer.error().message == "the run ends");
}

TEST_CASE("a connection ended by a living RTC is not made again", "[openrtm][peers][wallclock]") {
    WireRig rig("TimedLong", "connect(\"rtm:Out0.out\", \"relay.in\")");
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.hears(*out, "joined ") == "joined Out0.out_relay.in");
    REQUIRE(rig.tells_line("connected: rtm:Out0.out to relay.in"));
    CHECK(asked(rig, {.name = "Out0"}).find("out out  TimedLong  1 connection") != std::string::npos);
    CHECK(rig.answer(*out, "disconnect", "disconnected ") == "disconnected 0");
    CHECK(rig.tells("disconnected by an RTC or a tool: rtm:Out0.out to relay.in"));
    CHECK(rig.live->system().foreign_connections().empty());
    // What is said at a console brings it back.
    rig.told = "\n";
    REQUIRE(rig.live->act(Connect{"rtm:Out0.out", "relay.in"}, {Actor::Kind::console}));
    CHECK(rig.hears(*out, "joined ") == "joined Out0.out_relay.in");
    CHECK(rig.tells_line("connected: rtm:Out0.out to relay.in"));
    // And takes it away.
    REQUIRE(rig.live->act(Disconnect{"rtm:Out0.out", "relay.in"}, {Actor::Kind::console}));
    CHECK(rig.hears(*out, "left ") == "left Out0.out_relay.in");
}

TEST_CASE("an ambiguous name of two computers is refused with both", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto first = std::make_unique<Peer>(
        std::vector<std::string>{fake_rtc(), rig.address(), "a.host_cxt/Twin0", "out", "TimedLong", "out"});
    const auto second = std::make_unique<Peer>(
        std::vector<std::string>{fake_rtc(), rig.address(), "b.host_cxt/Twin0", "out", "TimedLong", "out"});
    REQUIRE(rig.hears(*first, "ready") == "ready");
    REQUIRE(rig.hears(*second, "ready") == "ready");
    CHECK(asked(rig, {.name = "Twin0"}) ==
          "! 'Twin0' could be rtm:a.host_cxt/Twin0 or rtm:b.host_cxt/Twin0: write one of them");
    CHECK(asked(rig, {.name = "b.host_cxt/Twin0"}).starts_with("rtm:b.host_cxt/Twin0  Fake, INACTIVE"));
}

TEST_CASE("the page sees all RTCs with their configuration, and which are ours", "[openrtm][peers][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    CHECK(rig.answer(*out, "connect In0 in dataflow_type=push", "connected") == "connected 0");
    auto look = rig.server->look();
    REQUIRE(rig.until([&] { return look.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
    const std::string told = look.get();
    CHECK(told.find(R"("name":"rtm:Out0","type":"Fake","state":"INACTIVE")") != std::string::npos);
    CHECK(told.find(R"("connections":[{"from":"rtm:Out0.out","to":"rtm:In0.in"}])") != std::string::npos);
    CHECK(told.find(R"("relay.in":"TimedLong")") != std::string::npos);
    CHECK(told.find("relay0") == std::string::npos);  // it is a component of ours
    CHECK(told.find(R"("min":0.0,"max":2.0,"step":0.1,"widget":"slider")") != std::string::npos);
}
