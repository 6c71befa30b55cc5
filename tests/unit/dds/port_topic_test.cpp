// Messages between hosts: which count, how old they are.
#include "bindings/dds/port_topic.hpp"

#include <catch2/catch.hpp>

#include "bindings/dds/domain_xml.hpp"
#include "engine/ports/port.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/dds/fake_domain.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

// An inlet for velocities, and who sends to it.
struct Line {
    FakeDomain domain;
    std::unique_ptr<DdsTransport> place = domain.join();
    OutPort<Velocity2D> port{"speed"};
    Topic topic = topic_of("ev3", "part.speed", port.type());
    std::unique_ptr<Writer> writer = place->write(topic);
    Progress progress;
    Inlet inlet{port.type(), place->read(topic), progress};

    void send(const MessageHead& head, const Velocity2D& velocity) const {
        Octets bytes;
        write_cdr(bytes, {.header = true}, head, velocity);
        writer->write(bytes);
    }
    // Whether something is published at this time of ours [s].
    bool receive(double clock, std::optional<std::uint64_t> run = 7) {
        inlet.receive(run, clock, [this](const Value& value) { port.write_any(value); });
        return port.latch({.tick = 1, .seconds = 50});
    }
};

}  // namespace

TEST_CASE("of velocities and pictures the newest are sent, all other messages are delivered", "[dds]") {
    const Topic velocity = topic_of("ev3", "a.b", message_of<Velocity2D>());
    CHECK(velocity.name == "nezumi/ev3/a/b");
    CHECK(velocity.type == "nezumi::TimedVelocity2D");
    CHECK_FALSE(velocity.reliable);
    CHECK(velocity.depth == 1);
    CHECK(topic_of("ev3", "a.b", message_of<std::int32_t>()).reliable);
    CHECK(topic_of("ev3", "a.b", message_of<std::int32_t>()).depth == 128);
    CHECK(topic_of("ev3", "a.b", message_of<CameraImage>()).depth == 2);
}

TEST_CASE("a velocity older than 0.5 s is dropped, also if the clocks are not set", "[dds]") {
    Line line;
    line.send({.run = 7, .number = 1, .stamp = 2.0, .offset = 100.0}, {.vx = 0.1});  // sent at 102 of theirs
    CHECK(line.receive(5000.0));
    line.send({.run = 7, .number = 2, .stamp = 2.1, .offset = 100.0}, {.vx = 0.2});
    CHECK(line.receive(5000.55));  // 0.45 s late
    line.send({.run = 7, .number = 3, .stamp = 2.2, .offset = 100.0}, {.vx = 0.3});
    CHECK_FALSE(line.receive(5000.71));
    CHECK(line.inlet.counts().late == 1);
    CHECK(line.inlet.counts().taken == 2);
}

TEST_CASE("a velocity that was measured long ago is old even if it arrives at once", "[dds]") {
    Line line;
    OutPort<Velocity2D> out{"speed"};
    std::uint64_t number = 0;
    const System system({}, {});
    Outlet outlet(system, out, line.place->write(line.topic), number);
    const auto publish = [&](double now, double measured) {
        out.write({.vx = 0.1});
        out.stamp(measured);
        out.latch({.tick = 1, .seconds = now});
        outlet.send({.tick = 1, .seconds = now}, 7, 500 + now);
        return line.receive(5000 + now);
    };
    CHECK(publish(10, 10));
    CHECK(publish(10.01, 9.55));
    CHECK_FALSE(publish(10.02, 9.5));
    CHECK(line.inlet.counts().late == 1);
}

TEST_CASE("the sender's pause makes no message old", "[dds]") {
    Line line;
    line.send({.run = 7, .number = 1, .stamp = 2.0, .offset = 100.0}, {.vx = 0.1});
    CHECK(line.receive(5000.0));
    line.send({.run = 7, .number = 2, .stamp = 2.01, .offset = 160.0}, {.vx = 0.2});  // its time stood for 60 s
    CHECK(line.receive(5060.01));
}

TEST_CASE("repeated messages, and those of another run or no host, are rejected", "[dds]") {
    Line line;
    line.send({.run = 7, .number = 1, .offset = 100}, {});
    CHECK(line.receive(1));
    line.send({.run = 7, .number = 1, .offset = 100}, {});
    CHECK_FALSE(line.receive(1));
    line.send({.run = 6, .number = 2, .offset = 100}, {});
    CHECK_FALSE(line.receive(1));
    line.send({.run = 7, .number = 2, .offset = 100}, {});
    CHECK_FALSE(line.receive(1, std::nullopt));
    CHECK(line.inlet.counts().wrong == 3);
    line.send({.run = 9, .number = 1, .offset = 3}, {});
    CHECK(line.receive(1, 9));
}

TEST_CASE("messages of a wrong type or with numbers that are not finite are rejected", "[dds]") {
    Line line;
    const Octets bytes{0, 1, 0, 0, 1, 2, 3};
    line.writer->write(bytes);
    CHECK_FALSE(line.receive(1));
    line.writer->write({});
    CHECK_FALSE(line.receive(1));
    line.send({.run = 7, .number = 1}, {.vx = std::numeric_limits<double>::quiet_NaN()});
    CHECK_FALSE(line.receive(1));
    line.send({.run = 7, .number = 2, .offset = std::numeric_limits<double>::infinity()}, {});
    CHECK_FALSE(line.receive(1));
    line.send({.run = 7, .number = 3, .stamp = 1e308, .offset = 1e308}, {});
    CHECK_FALSE(line.receive(1));
    CHECK(line.inlet.counts().wrong == 5);
}

TEST_CASE("an outlet sends every message of a tick with its head", "[dds]") {
    FakeDomain domain;
    const auto place = domain.join();
    OutPort<std::int32_t> port{"count"};
    const Topic topic = topic_of("ev3", "part.count", port.type());
    const auto reader = place->read(topic);
    std::uint64_t number = 41;
    const System system({}, {});
    Outlet outlet(system, port, place->write(topic), number);
    port.write(3);
    port.write(4);
    port.latch({.tick = 9, .seconds = 0.09});
    outlet.send({.tick = 9, .seconds = 0.09}, 7, 1000.09);
    outlet.send({.tick = 10, .seconds = 0.1}, 7, 1000.1);
    const auto samples = reader->take();
    REQUIRE(samples.size() == 2);
    MessageHead head;
    std::int32_t value = 0;
    REQUIRE(read_cdr(samples[1].bytes, {.header = true}, head, value));
    CHECK(value == 4);
    CHECK(head.run == 7);
    CHECK(head.number == 43);
    CHECK(head.tick == 9);
    CHECK(head.stamp == 0.09);
    CHECK(head.offset == Approx(1000));
}

TEST_CASE("without an interface a domain uses the loopback, and its configuration is quoted", "[dds]") {
    const std::string loopback = domain_xml("", {});
    CHECK(loopback.find("<NetworkInterface name=\"lo\"/>") != std::string::npos);
    CHECK(loopback.find("<AllowMulticast>false</AllowMulticast>") != std::string::npos);
    CHECK(loopback.find("<Peers><Peer address=\"127.0.0.1\"/></Peers>") != std::string::npos);
    const std::string wlan = domain_xml("w\"<&${HOME}", {"10.0.0.2", "pi.local"});
    CHECK(wlan.find("name=\"w&quot;&lt;&amp;&#36;{HOME}\"") != std::string::npos);
    CHECK(wlan.find("<AllowMulticast>spdp</AllowMulticast>") != std::string::npos);
    CHECK(wlan.find("<Peers><Peer address=\"10.0.0.2\"/><Peer address=\"pi.local\"/></Peers>") != std::string::npos);
}

TEST_CASE("a port that is opened again does not take earlier messages", "[dds]") {
    Line line;
    line.send({.run = 7, .number = 5, .offset = 100}, {});
    CHECK(line.receive(1));
    Inlet again(line.port.type(), line.place->read(line.topic), line.progress);
    line.send({.run = 7, .number = 5, .offset = 100}, {});
    again.receive(7, 2, [&](const Value& value) { line.port.write_any(value); });
    CHECK_FALSE(line.port.latch({.tick = 2, .seconds = 51}));
    CHECK(again.counts().wrong == 1);
}
