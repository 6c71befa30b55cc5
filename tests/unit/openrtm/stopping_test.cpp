// Robots at either end of a connection stop: when an RTC has stopped executing, and when the connection ends.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;

namespace {

using namespace std::chrono_literals;

const std::string forward = hex_of(Velocity2D{.vx = 0.1}, std::endian::little);
// Without a stamp.
const std::string unstamped_forward = std::string(16, '0') + forward.substr(16);

const VelocityGuard& mouse_of(WireRig& rig) { return rig.live->system().find_robot("mouse")->guard(); }

bool drives(WireRig& rig) {
    return rig.until([&] { return mouse_of(rig).current().vx > 0.09; });
}
bool stands(WireRig& rig) {
    return rig.until([&] { return mouse_of(rig).current() == Velocity2D{}; });
}
// For longer than a robot goes on without a word.
bool keeps_driving(WireRig& rig) {
    return !rig.until([&] { return mouse_of(rig).current().vx < 0.05; }, 1.5);
}

std::unique_ptr<Peer> driver(WireRig& rig, const std::string& terms, bool reads_back = true) {
    auto out = rig.rtc("Out0", "out", "TimedVelocity2D", "out");
    if (reads_back) out->say("readback");
    REQUIRE(rig.answer(*out, "connect mouse0 target_velocity_in " + terms, "connected ") == "connected 0");
    return out;
}

// What an RTC has read last, up to now.
bool last_read_is_zero(Peer& robot) {
    const std::string& text = robot.text();
    const std::size_t at = text.rfind("reads ");
    REQUIRE(at != std::string::npos);
    const std::string message = text.substr(at + 6, text.find('\n', at) - at - 6);
    return message.size() == forward.size() && message.substr(16).find_first_not_of('0') == std::string::npos;
}

// A relay whose out-port drives an RTC's robot that reads some times a second, and does so already.
struct Driven {
    explicit Driven(const std::string& terms, double rate = 5) : rig("TimedVelocity2D") {
        robot = rig.rtc("Robot0", "in", "TimedVelocity2D", "in");
        REQUIRE(rig.answer(*robot, "connect relay0 out " + terms, "connected ") == "connected 0");
        robot->say("execute " + std::to_string(rate));
        go();
        const std::string read = hears("reads ");
        REQUIRE(read.ends_with(forward.substr(16)));
    }
    void go() {
        rig.publish(Velocity2D{.vx = 0.1});
        rig.turn();
    }
    std::string hears(const std::string& begin) {
        return robot->heard(begin, [&] { go(); });
    }
    WireRig rig;
    std::unique_ptr<Peer> robot;
};

}  // namespace

TEST_CASE("a robot stops when the RTC that it fetches from stops executing", "[openrtm][stopping][wallclock]") {
    WireRig rig;
    SECTION("it stamps, and reads back") {
        const auto out = driver(rig, "dataflow_type=pull");
        out->say("execute 100 " + forward + " stamped");
        CHECK(drives(rig));
        CHECK(keeps_driving(rig));
        out->say("stall");
        CHECK(stands(rig));
    }
    SECTION("it does not stamp, and gives nothing when it has nothing, as it is asked to") {
        const auto out = driver(rig, "last dataflow_type=pull");
        out->say("execute 100 " + unstamped_forward);
        CHECK(drives(rig));
        CHECK(keeps_driving(rig));
        out->say("stall");
        CHECK(stands(rig));
    }
    SECTION("it does not stamp, and reads back: what it repeats is silence") {
        const auto out = driver(rig, "dataflow_type=pull");
        out->say("execute 100 " + unstamped_forward);
        CHECK(drives(rig));
        CHECK(stands(rig));
        CHECK(
            rig.tells("rtm: mouse.target_velocity_in: made by the fake repeats a velocity without a stamp: it counts "
                      "once, and the robot stops after 0.5 s; stamp what the RTC writes, or connect it with "
                      "dataflow_type push and subscription_type flush or new\n"));
    }
}

TEST_CASE("an RTC is asked to report an empty buffer", "[openrtm][stopping][wallclock]") {
    // Its choice stays where it was made.
    const auto [said, is_silent] =
        GENERATE(table<std::string, bool>({{"", true}, {" outport.buffer.read.empty_policy=readback", false}}));
    CAPTURE(said);
    WireRig rig;
    const auto out = driver(rig, "last dataflow_type=pull" + said);
    out->say("execute 100 " + unstamped_forward);
    CHECK(drives(rig));
    CHECK(keeps_driving(rig) == is_silent);
}

TEST_CASE("a robot stops when an RTC's periodic publisher repeats the last velocity",
          "[openrtm][stopping][wallclock]") {
    WireRig rig;
    const auto out = driver(rig, "subscription_type=periodic push_rate=100");
    out->say("execute 100 " + forward + " stamped");
    CHECK(drives(rig));
    CHECK(keeps_driving(rig));
    out->say("execute 100 " + forward);
    CHECK(stands(rig));
}

TEST_CASE("a velocity without a stamp that is pushed repeatedly drives on", "[openrtm][stopping][wallclock]") {
    WireRig rig;
    const auto out = driver(rig, "subscription_type=new");
    out->say("execute 100 " + unstamped_forward);
    CHECK(drives(rig));
    CHECK(keeps_driving(rig));
}

TEST_CASE("a value that is read again is not a new message", "[openrtm][stopping][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    out->say("readback");
    REQUIRE(rig.answer(*out, "connect relay0 in dataflow_type=pull", "connected ") == "connected 0");
    const Port& in = *rig.component("relay").find_in_port("in");
    CHECK(rig.answer(*out, "send " + hex_of(std::int32_t{9}, std::endian::little), "kept") == "kept");
    CHECK(rig.until([&] { return in.count() > 0; }));
    CHECK_FALSE(rig.until([&] { return in.count() > 1; }, 0.5));
}

TEST_CASE("an RTC robot reads zero before its connection ends", "[openrtm][stopping][wallclock]") {
    const std::string terms = GENERATE("dataflow_type=push", "dataflow_type=pull", "subscription_type=new",
                                       "subscription_type=periodic push_rate=20");
    const auto [how, end] = GENERATE(table<std::string, std::function<void(Driven&)>>({
        {"the run ends", [](Driven& each) { each.rig.server.reset(); }},
        {"its component is removed",
         [](Driven& each) {
             REQUIRE(each.rig.live->act(Remove{"relay"}, {Actor::Kind::console}));
             each.rig.turn();
         }},
        {"a tool disconnects", [](Driven& each) { each.robot->say("disconnect"); }},
    }));
    CAPTURE(terms, how);
    Driven each(terms);
    end(each);
    REQUIRE(each.robot->heard("left ") != "");
    CHECK(last_read_is_zero(*each.robot));
}

TEST_CASE("an RTC robot reads zero when the console ends its connection", "[openrtm][stopping][wallclock]") {
    WireRig rig("TimedVelocity2D", "connect(\"relay.out\", \"rtm:Robot0.in\")");
    const auto robot = rig.rtc("Robot0", "in", "TimedVelocity2D", "in");
    REQUIRE(rig.hears(*robot, "joined ") != "");
    robot->say("execute 5");
    REQUIRE(robot->heard("reads ", [&] {
        rig.publish(Velocity2D{.vx = 0.1});
        rig.turn();
    }) != "");
    REQUIRE(rig.live->act(Disconnect{"relay.out", "rtm:Robot0.in"}, {Actor::Kind::console}));
    REQUIRE(robot->heard("left ", [&] {
        rig.publish(Velocity2D{.vx = 0.1});
        rig.turn();
    }) != "");
    CHECK(last_read_is_zero(*robot));
}

TEST_CASE("the end of a connection does not wait long for a robot that does not read, or hangs",
          "[openrtm][stopping][wallclock]") {
    const auto [how, fail] = GENERATE(table<std::string, std::function<void(Driven&)>>({
        {"it does not execute", [](Driven& each) { each.robot->say("stall"); }},
        {"it hangs", [](Driven& each) { each.robot->halt(); }},
    }));
    const std::string terms = GENERATE("dataflow_type=push", "dataflow_type=pull");
    CAPTURE(how, terms);
    Driven each(terms);
    fail(each);
    each.go();
    const auto begin = std::chrono::steady_clock::now();
    each.rig.server.reset();
    CHECK(std::chrono::steady_clock::now() - begin < 6s);
}

TEST_CASE("an RTC robot reads zero when its port becomes silent", "[openrtm][stopping][wallclock]") {
    const std::string terms =
        GENERATE("dataflow_type=push", "dataflow_type=pull", "subscription_type=periodic push_rate=20");
    CAPTURE(terms);
    Driven each(terms, 50);
    // As when time stands: no tick, and so no message.
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (!last_read_is_zero(*each.robot) && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(10ms);
    CHECK(last_read_is_zero(*each.robot));
}
