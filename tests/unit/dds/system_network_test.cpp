// Connections between hosts: made, refused, ended and made again, whichever end is asked.
#include <catch2/catch.hpp>

#include "tests/unit/dds/host_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("messages of another host's port arrive", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
    pass(room, 3, ev3, pi);
    CHECK(pi.connections() == Lines{"ev3/part.speed > part.target"});
    CHECK(ev3.connections() == Lines{"part.speed > pi/part.target"});
    CHECK(ev3.acts == Lines{"Connect by network pi"});
    CHECK(pi.acts.empty());
    ev3.part->speed.write({.vx = 0.25});
    pass(room, 1, ev3, pi);
    REQUIRE(pi.part->targets.size() == 1);
    CHECK(pi.part->targets[0].data == Velocity2D{.vx = 0.25});
    // By the one door, so that a journal has it.
    CHECK(pi.arrivals == Lines{"Write by network ev3"});
}

TEST_CASE("a connection can be requested at the sending host too", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(ev3.system.connect("part.count", "pi/part.number"));
    pass(room, 3, ev3, pi);
    CHECK(pi.connections() == Lines{"ev3/part.count > part.number"});
    CHECK(pi.acts == Lines{"Connect by network ev3"});
    for (const std::int32_t number : {1, 2, 3}) {
        ev3.part->count.write(number);
        ev3.part->count.write(10 * number);
        pass(room, 1, ev3, pi);
    }
    CHECK(pi.part->numbers == std::vector<std::int32_t>{1, 10, 2, 20, 3, 30});
}

TEST_CASE("a component that replaces another between two ticks continues to send for it", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(ev3.system.connect("part.count", "pi/part.number"));
    pass(room, 3, ev3, pi);
    REQUIRE(ev3.system.remove("part"));
    auto next = std::make_unique<Part>("part");
    ev3.part = next.get();
    REQUIRE(ev3.system.add(std::move(next)));
    REQUIRE(ev3.part->activate(ev3.system.now()));
    REQUIRE(ev3.system.connect("part.count", "pi/part.number"));
    ev3.part->count.write(7);
    pass(room, 3, ev3, pi);
    CHECK(pi.part->numbers == std::vector<std::int32_t>{7});
}

TEST_CASE("a connection waits for a missing host, and shows it", "[dds][network]") {
    Room room;
    HostRig pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
    pass(room, 2, pi);
    CHECK((*pi.system.port("ev3/part.speed"))->note() == "waits for host ev3");
    REQUIRE(pi.system.network()->hosts().size() == 1);
    CHECK_FALSE(pi.system.network()->hosts()[0].here);
    HostRig ev3(room, "ev3");
    pass(room, 3, ev3, pi);
    CHECK((*pi.system.port("ev3/part.speed"))->note().empty());
    CHECK(pi.told("info: host ev3 is here"));
    REQUIRE(pi.system.network()->hosts().size() == 1);
    CHECK(pi.system.network()->hosts()[0].here);
    CHECK(pi.system.network()->hosts()[0].ports.size() == 4);
    ev3.part->speed.write({.va = 1});
    pass(room, 1, ev3, pi);
    CHECK(pi.part->targets.size() == 1);
}

TEST_CASE("a connection survives the other host's restart", "[dds][network]") {
    Room room;
    HostRig pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.count", "part.number"));
    for (const std::int32_t number : {1, 2}) {
        HostRig ev3(room, "ev3");
        pass(room, 3, ev3, pi);
        ev3.part->count.write(number);
        pass(room, 1, ev3, pi);
    }
    pass(room, 2, pi);
    CHECK(pi.part->numbers == std::vector<std::int32_t>{1, 2});
    CHECK(pi.told("warn: host ev3 has left"));
    CHECK((*pi.system.port("ev3/part.count"))->note() == "waits for host ev3");
}

TEST_CASE("a connection ends on both hosts when it ends on one", "[dds][network]") {
    for (const bool by_asker : {true, false}) {
        CAPTURE(by_asker);
        Room room;
        HostRig ev3(room, "ev3"), pi(room, "pi");
        REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
        pass(room, 3, ev3, pi);
        if (by_asker) {
            REQUIRE(pi.system.disconnect("ev3/part.speed", "part.target"));
        } else {
            REQUIRE(ev3.system.disconnect("part.speed", "pi/part.target"));
        }
        pass(room, 4, ev3, pi);
        CHECK(pi.connections().empty());
        CHECK(ev3.connections().empty());
        CHECK(room.domain.topics() == Lines{"< nezumi/ev3/replies", "< nezumi/ev3/requests", "< nezumi/hosts",
                                            "< nezumi/hosts", "< nezumi/pi/replies", "< nezumi/pi/requests",
                                            "> nezumi/hosts", "> nezumi/hosts"});
        // And it can be made again.
        REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
        pass(room, 4, ev3, pi);
        CHECK(ev3.connections() == Lines{"part.speed > pi/part.target"});
    }
}

TEST_CASE("different types are reported at both ends", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.speed", "part.number"));
    pass(room, 4, ev3, pi);
    CHECK(
        ev3.told("warn: host pi asked for connect(part.speed, pi/part.number), which was refused: types differ: "
                 "ev3/part.speed is "
                 "TimedVelocity2D, pi/part.number is TimedLong"));
    CHECK(pi.told("warn: connect(ev3/part.speed, part.number): host ev3 refuses: types differ"));
    CHECK(pi.connections().empty());
    CHECK(ev3.connections().empty());
}

TEST_CASE("an unknown port of another host is reported with the most similar one", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.sped", "part.target"));
    pass(room, 3, ev3, pi);
    CHECK((*pi.system.port("ev3/part.sped"))->note() == "host ev3 has no port part.sped (did you mean 'part.speed'?)");
    CHECK(pi.connections() == Lines{"ev3/part.sped > part.target"});
}

TEST_CASE("read-only hosts can read but not write", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3", false), pi(room, "pi", false);
    REQUIRE(pi.system.connect("ev3/part.count", "part.number"));
    REQUIRE(pi.system.connect("part.speed", "ev3/part.target"));
    pass(room, 3, ev3, pi);
    ev3.part->count.write(5);
    pi.part->speed.write({.vx = 1});
    pass(room, 2, ev3, pi);
    CHECK(pi.part->numbers == std::vector<std::int32_t>{5});
    CHECK(ev3.part->targets.empty());
    CHECK(pi.told("host ev3 refuses: other hosts can only read"));
    CHECK(pi.connections() == Lines{"ev3/part.count > part.number"});
}

TEST_CASE("two hosts with one name are reported at both and at a third", "[dds][network]") {
    Room room;
    HostRig one(room, "ev3"), two(room, "ev3"), pi(room, "pi");
    pass(room, 30, one, two, pi);
    CHECK_FALSE(one.told("another host is also called"));
    pass(room, 60, one, two, pi);
    CHECK(one.told("error: another host is also called ev3"));
    CHECK(two.told("error: another host is also called ev3"));
    CHECK(pi.told("error: two hosts have the name ev3"));
}

TEST_CASE("hosts of different versions are reported", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3", true, "1.1"), pi(room, "pi");
    pass(room, 2, ev3, pi);
    CHECK(pi.told(fmt::format(
        "warn: host ev3 is here; it runs nezumi 1.1, protocol {0}, this one nezumi 1.0, protocol {0}", protocol)));
}

TEST_CASE("only the last announcement since the last check counts", "[dds][network]") {
    Room room;
    HostRig pi(room, "pi");
    pass(room, 1, pi);
    const auto place = room.domain.join();
    const auto writer = place->write(announcement_topic());
    const auto says = [&](const std::string& version, std::uint64_t number) {
        Announcement said;
        said.head = {.protocol = protocol, .host = "ev3", .version = version};
        said.run = 4711;
        said.number = number;
        writer->write(write_announcement(said));
    };
    says("1.1", 1);
    says("1.2", 2);
    writer->write(Octets{0, 1, 0, 0, 1, 2, 3});
    pass(room, 1, pi);
    CHECK(pi.told("host ev3 is here; it runs nezumi 1.2"));
    CHECK_FALSE(pi.told("1.1"));
}

TEST_CASE("after an interrupted connection no old velocity is used, and the number of missed messages is shown",
          "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
    pass(room, 3, ev3, pi);
    ev3.part->speed.write({.vx = 0.1});
    pass(room, 1, ev3, pi);
    room.domain.cut = true;
    for (int i = 0; i < 5; ++i) {
        ev3.part->speed.write({.vx = 0.2});
        pass(room, 1, ev3, pi);
    }
    room.domain.cut = false;
    CHECK(pi.part->targets.size() == 1);
    ev3.part->speed.write({.vx = 0.3});
    pass(room, 2, ev3, pi);
    REQUIRE(pi.part->targets.size() == 2);
    CHECK(pi.part->targets[1].data.vx == 0.3);
    CHECK((*pi.system.port("ev3/part.speed"))->note() == "5 messages missed, 0 late, 0 wrong");
}

TEST_CASE("a deactivated remote component takes no messages from its host", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.count", "part.number"));
    pass(room, 3, ev3, pi);
    REQUIRE((*pi.system.component("ev3/part"))->deactivate(pi.system.now()));
    ev3.part->count.write(1);
    pass(room, 2, ev3, pi);
    CHECK(pi.part->numbers.empty());
}

TEST_CASE("a hold on another host's in-port is refused", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("part.speed", "ev3/part.target"));
    pass(room, 3, ev3, pi);
    const Actor user{Actor::Kind::console};
    const Velocity2D fast{.vx = 0.2};
    const std::string why =
        "ev3/part.target gets its messages on host 'ev3': do this on that host, or with the out-port of this "
        "host that it is connected to";
    for (const Act& each : {Act{Hold{.port = "ev3/part.target", .value = fast}}, Act{Inject{"ev3/part.target", fast}},
                            Act{Drop{"ev3/part.target"}}, Act{Freeze{"ev3/part.target"}}}) {
        const auto done = pi.act(each, user);
        REQUIRE_FALSE(done);
        CHECK(done.error().message == why);
    }
    CHECK(pi.act(Hold{.port = "part.speed", .value = fast}, user));
    REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
    CHECK(pi.act(Hold{.port = "ev3/part.speed", .value = fast}, user));  // what comes from there is read here
}

TEST_CASE("removing a component removes its end of a connection", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(pi.system.connect("ev3/part.speed", "part.target"));
    pass(room, 3, ev3, pi);
    REQUIRE(ev3.system.remove("part"));
    pass(room, 3, ev3, pi);
    CHECK((*pi.system.port("ev3/part.speed"))->note() == "host ev3 has no port part.speed");
}

TEST_CASE("a connection to another host needs a network", "[dds][network]") {
    System system({}, nullptr);
    REQUIRE(system.add(std::make_unique<Part>("part")));
    CHECK(system.connect("ev3/part.speed", "part.target").error().message ==
          "ev3/part.speed is on another host: add network { name = ... } to the system file");
}
