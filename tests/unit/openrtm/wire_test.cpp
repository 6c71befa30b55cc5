// Messages between a system and RTCs that are other programs: every type, both directions, push and pull.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <thread>

#include "tests/unit/openrtm/samples.hpp"
#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;

namespace {

std::string endian_of(std::endian order) {
    return std::string(" serializer.cdr.endian=") + (order == std::endian::little ? "little,big" : "big,little");
}

// Publishes until an RTC has got it: a message that is published before the connection is made is lost.
Value received(WireRig& rig, Peer& peer, const Value& value, std::endian order) {
    rig.publish(value);
    rig.turn();
    return payload_of(rig.hears(peer, "got "), message_of(value.type()), order);
}

}  // namespace

TEST_CASE("every type is pushed to an RTC and from one, in both byte orders", "[openrtm][wire][wallclock]") {
    for (const Value& sample : samples()) {
        const std::string_view type = message_name(sample.type());
        CAPTURE(type);
        WireRig rig(type);
        const auto in = rig.rtc("In0", "in", type, "in");
        const auto out = rig.rtc("Out0", "out", type, "out");
        for (const std::endian order : {std::endian::little, std::endian::big}) {
            CAPTURE(order == std::endian::little);
            REQUIRE(rig.answer(*in, "connect relay0 out dataflow_type=push" + endian_of(order), "connected ") ==
                    "connected 0");
            CHECK(received(rig, *in, sample, order) == sample);
            CHECK(rig.answer(*in, "disconnect", "disconnected ") == "disconnected 0");

            rig.component("relay").find_in_port("in")->clear();
            REQUIRE(rig.answer(*out, "connect relay0 in dataflow_type=push" + endian_of(order), "connected ") ==
                    "connected 0");
            CHECK(rig.answer(*out, "send " + hex_of(sample, order), "sent ") == "sent 0");
            CHECK(rig.until([&] { return rig.arrived() == sample; }));
            CHECK(rig.answer(*out, "disconnect", "disconnected ") == "disconnected 0");
        }
    }
}

TEST_CASE("messages are fetched from both sides", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.answer(*in, "connect relay0 out dataflow_type=pull", "connected ") == "connected 0");
    in->say("fetch");
    CHECK(rig.hears(*in, "empty") == "empty");
    rig.publish(std::int32_t{7});
    rig.turn();
    in->say("fetch");
    CHECK(payload_of(rig.hears(*in, "got "), message_of<std::int32_t>(), std::endian::little) ==
          Value(std::int32_t{7}));

    REQUIRE(rig.answer(*out, "connect relay0 in dataflow_type=pull", "connected ") == "connected 0");
    CHECK(rig.answer(*out, "send " + hex_of(std::int32_t{9}, std::endian::little), "kept") == "kept");
    CHECK(rig.until([&] { return rig.arrived() == Value(std::int32_t{9}); }));
}

TEST_CASE("an out-port can have several connections, but none twice", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto first = rig.rtc("In0", "in", "TimedLong", "in");
    const auto second = rig.rtc("In1", "in", "TimedLong", "in");
    CHECK(rig.answer(*first, "connect relay0 out dataflow_type=push", "connected ") == "connected 0");
    CHECK(rig.answer(*second, "connect relay0 out dataflow_type=push", "connected ") == "connected 0");
    CHECK(rig.answer(*first, "connect relay0 out dataflow_type=push", "connected ") == "connected 5");
    rig.publish(std::int32_t{7});
    rig.turn();
    for (const auto& peer : {first.get(), second.get()})
        CHECK(payload_of(rig.hears(*peer, "got "), message_of<std::int32_t>(), std::endian::little) ==
              Value(std::int32_t{7}));
}

TEST_CASE("of two simultaneous connections between the same ports one is accepted", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    CHECK(rig.answer(*out, "race relay0 in 20", "wrong ") == "wrong 0");
}

TEST_CASE("an impossible connection is refused", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    for (const std::string properties :
         {"interface_type=shared_memory", "data_type=IDL:RTC/TimedDouble:1.0", "dataflow_type=duplex",
          "subscription_type=sometimes", "serializer.cdr.endian=middle", "marshaling_type=json",
          "subscription_type=periodic push_rate=-1"}) {
        CAPTURE(properties);
        CHECK(rig.answer(*in, "connect relay0 out " + properties, "connected ") == "connected 2");
    }
}

TEST_CASE("a connection with too long a name, id or list of properties is refused", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    for (const std::string what : {"name=", "id="}) {
        CAPTURE(what);
        CHECK(rig.answer(*in, "connect relay0 out " + what + std::string(257, 'x'), "connected ") == "connected 2");
        CHECK(rig.answer(*in, "connect relay0 out " + what + std::string(256, 'x'), "connected ") == "connected 0");
        CHECK(rig.answer(*in, "disconnect", "disconnected ") == "disconnected 0");
    }
    CHECK(rig.answer(*in, "connect relay0 out comment=" + std::string(65'536, 'x'), "connected ") == "connected 2");
    CHECK(rig.answer(*in, "connect relay0 out comment=" + std::string(32'768, 'x'), "connected ") == "connected 0");
}

TEST_CASE("the size of an RTC's answer to a connection is limited too", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    in->say("boast 65536");
    REQUIRE(rig.answer(*in, "state relay0", "state ") == "state 2");  // so it has begun to
    REQUIRE(rig.live->act(Connect{"relay.out", "rtm:In0.in"}, {Actor::Kind::console}));
    CHECK(rig.tells("not connected: relay.out to rtm:In0.in: it does not accept the connection's type or properties"));
}

TEST_CASE("properties may be in upper or lower case, and the first byte order counts", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    REQUIRE(rig.answer(*in,
                       "connect relay0 out interface_type=CORBA_CDR dataflow_type=Push subscription_type=New "
                       "serializer.cdr.endian=Big,Little",
                       "connected ") == "connected 0");
    CHECK(received(rig, *in, std::int32_t{7}, std::endian::big) == Value(std::int32_t{7}));
}

TEST_CASE("an invalid message is refused, and the connection stays", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.answer(*out, "connect relay0 in", "connected ") == "connected 0");
    CHECK(rig.answer(*out, "send 0102", "sent ") == "sent 1");
    CHECK(rig.tells("rtm: relay.in refuses a malformed message from connection 'made by the fake': "));
    CHECK(rig.answer(*out, "send " + hex_of(std::int32_t{9}, std::endian::little), "sent ") == "sent 0");
    CHECK(rig.until([&] { return rig.arrived() == Value(std::int32_t{9}); }));
    CHECK(rig.server->malformed() == 1);
}

TEST_CASE("a periodic connection sends the latest message at its rate", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto in = rig.rtc("In0", "in", "TimedLong", "in");
    REQUIRE(rig.answer(*in, "connect relay0 out subscription_type=periodic push_rate=5", "connected ") ==
            "connected 0");
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    std::int32_t number = 0;
    while (std::chrono::steady_clock::now() < end) {
        rig.publish(++number);
        rig.turn();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::size_t count = 0;
    const std::string& text = in->text();
    for (std::size_t at = text.find("got "); at != std::string::npos; at = text.find("got ", at + 1)) ++count;
    CHECK(count >= 2);
    CHECK(count <= 7);
}

TEST_CASE("an RTC sees profile, life cycle and configuration, and changes them", "[openrtm][wire][wallclock]") {
    WireRig rig;
    const auto peer = rig.rtc("In0", "in", "TimedLong", "in");
    CHECK(rig.answer(*peer, "ports relay0", "ports ") ==
          "ports relay0 relay0.in DataInPort IDL:RTC/TimedLong:1.0 relay0.out DataOutPort IDL:RTC/TimedLong:1.0");
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    CHECK(rig.answer(*peer, "about relay0", "about ") ==
          fmt::format("about Relay, Relay, 1.0, nezumi, nezumi, {}.host_cxt/relay0.rtc", host));
    CHECK(rig.answer(*peer, "state relay0", "state ") == "state 2");
    CHECK(rig.answer(*peer, "deactivate relay0", "done ") == "done 0");
    CHECK(rig.component("relay").state() == LifeState::inactive);
    CHECK(rig.answer(*peer, "state relay0", "state ") == "state 1");
    CHECK(rig.answer(*peer, "reset relay0", "done ") == "done 5");
    CHECK(rig.answer(*peer, "activate relay0", "done ") == "done 0");
    CHECK(rig.answer(*peer, "activate relay0", "done ") == "done 5");  // PRECONDITION_NOT_MET
    CHECK(rig.answer(*peer, "sets relay0", "sets ") ==
          "sets default | default speed=0.5 | __widget__ | __constraints__ speed=0<=x<=1 | __type__ speed=double");
    CHECK(rig.answer(*peer, "set relay0 default speed 0.75", "done ") == "done 1");
    CHECK(rig.until([&] { return rig.component("relay").parameters().find("speed")->value.get<double>() == 0.75; }));
    CHECK(rig.answer(*peer, "set relay0 default speed 7", "done ") == "done 0");
    CHECK(rig.answer(*peer, "set relay0 default sped 0.5", "invalid ") == "invalid there is no parameter of this name");
    CHECK(rig.answer(*peer, "use relay0 fast", "invalid ") == "invalid there is no configuration set of this name");
}
