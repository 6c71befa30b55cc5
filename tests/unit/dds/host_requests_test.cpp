// What hosts ask of each other's components.
#include <catch2/catch.hpp>

#include "bindings/dds/host_requests.hpp"
#include "engine/live/answer_question.hpp"
#include "engine/trace/recent_curves.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/dds/host_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

using Lines = std::vector<std::string>;
using What = Question::What;

Question question(What what, const std::string& name = "", PlainData values = {}) {
    return {.host = "ev3", .component = "part", .what = what, .name = name, .values = std::move(values)};
}

// The value that a look has found.
Value looked(const Expected<PlainData>& data) {
    REQUIRE(data.has_value());
    const auto look = read_snapshot(*data);
    REQUIRE(look.has_value());
    return look->value.data.values.at(0);
}

PlainData one(Value value) {
    PlainData data;
    data.values.push_back(std::move(value));
    return data;
}

std::string text(const Expected<PlainData>& answer) {
    if (!answer) return "! " + answer.error().message;
    return answer->values.empty() ? "" : answer->values[0].get<std::string>();
}

}  // namespace

TEST_CASE("a component of another host shows its state and executes requests", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(ev3.part->parameters().declare({.name = "speed", .initial = 0.5, .min = 0.0, .max = 1.0}));
    REQUIRE(ev3.part->parameters().declare({.name = "list", .initial = std::vector<double>{1.0}}));
    pass(room, 3, ev3, pi);
    CHECK(looked(pi.ask(question(What::look, "status"), ev3)) == Value{"ACTIVE"});
    CHECK(looked(pi.ask(question(What::look, "type"), ev3)) == Value{"Part"});
    CHECK(ev3.acts.empty());  // looking is not an act
    CHECK(text(pi.ask(question(What::deactivate), ev3)) == "INACTIVE");
    CHECK(ev3.part->state() == LifeState::inactive);
    CHECK(text(pi.ask(question(What::activate), ev3)) == "ACTIVE");
    CHECK(text(pi.ask(question(What::set, "speed", one(0.25)), ev3)) == "");
    CHECK(ev3.part->parameters().find("speed")->value == Value{0.25});
    CHECK(text(pi.ask(question(What::set, "list", one(std::vector<double>{2.5, 3.0})), ev3)) == "");
    CHECK(ev3.part->parameters().find("list")->value == Value{std::vector<double>{2.5, 3.0}});
    CHECK(ev3.acts == Lines{"Deactivate by network pi", "Activate by network pi", "SetParameter by network pi",
                            "SetParameter by network pi"});
}

TEST_CASE("a refusal by another host is reported with its name", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    REQUIRE(ev3.part->parameters().declare({.name = "speed", .initial = 0.5, .min = 0.0, .max = 1.0}));
    pass(room, 3, ev3, pi);
    CHECK(text(pi.ask(question(What::set, "speed", one(2.0)), ev3)) ==
          "! host ev3: parameter 'speed' (number): 2.0 is above its maximum 1.0");
    CHECK(text(pi.ask(question(What::set, "sped", one(1.0)), ev3)).find("! host ev3: unknown parameter 'sped'") == 0);
    Question none = question(What::look);
    none.component = "prt";
    CHECK(text(pi.ask(none, ev3)).find("(did you mean 'part'?)") != std::string::npos);
    none.host = "ev4";
    CHECK(text(pi.ask(none, ev3)) == "! there is no host 'ev4' (did you mean 'ev3'?)");
    none.host = "pi";
    CHECK(text(pi.ask(none, ev3)) == "! pi is this host: write the component's name without 'pi/'");
}

TEST_CASE("read-only hosts can see components but change nothing", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3", false), pi(room, "pi");
    pass(room, 3, ev3, pi);
    CHECK(looked(pi.ask(question(What::look, "status"), ev3)) == Value{"ACTIVE"});
    CHECK(text(pi.ask(question(What::deactivate), ev3)).find("! host ev3: other hosts can only read") == 0);
    CHECK(text(pi.ask(question(What::connect, "target", one(std::string("pi/part.speed"))), ev3))
              .find("! host ev3: other hosts can only read") == 0);
    CHECK(ev3.part->state() == LifeState::active);
}

TEST_CASE("the values of another host's port can be seen without a connection", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3", false), pi(room, "pi");
    pass(room, 3, ev3, pi);
    const auto none = pi.ask(question(What::port, "speed"), ev3);
    REQUIRE(none.has_value());
    CHECK(none->values.at(1) == Value{std::int64_t{0}});
    CHECK(pi.ask(question(What::curves, "speed.vx", one(10.0)), ev3)->values.size() == 2);  // remembered from now on
    for (int i = 1; i <= 3; ++i) {
        ev3.part->speed.write({.vx = 0.1 * i});
        pass(room, 1, ev3, pi);
    }
    const auto last = pi.ask(question(What::port, "speed"), ev3);
    REQUIRE(last.has_value());
    CHECK(last->values.at(1) == Value{std::int64_t{3}});
    CHECK(last->values.at(2) == Value{"{ vx = 0.3, vy = 0, va = 0 }"});
    const auto data = pi.ask(question(What::curves, "speed.vx", one(10.0)), ev3);
    REQUIRE(data.has_value());
    const auto recent = read_curves(*data);
    REQUIRE(recent.has_value());
    REQUIRE(recent->curves.size() == 1);
    CHECK(recent->curves[0].name == "vx");
    CHECK(recent->curves[0].points.back().second == Approx(0.3));
    CHECK(ev3.acts.empty());
    CHECK(pi.connections().empty());
    CHECK(text(pi.ask(question(What::port, "sped"), ev3)) ==
          "! host ev3: part has no port 'sped' (did you mean 'speed'?)");
    CHECK(text(pi.ask(question(What::curves, "speed.vz", one(10.0)), ev3)).find("! host ev3: part.speed has no 'vz'") ==
          0);
}

TEST_CASE("a third host connects two others", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi"), pc(room, "pc");
    pass(room, 3, ev3, pi, pc);
    const auto from_pi = [] { return one(std::string("pi/part.speed")); };
    CHECK(text(pc.ask(question(What::connect, "target", from_pi()), ev3, pi)) == "");
    CHECK(ev3.acts == Lines{"Connect by network pc"});
    pass(room, 3, ev3, pi, pc);
    CHECK(ev3.connections() == Lines{"pi/part.speed > part.target"});
    CHECK(pi.connections() == Lines{"part.speed > ev3/part.target"});
    CHECK(pc.connections().empty());
    CHECK_FALSE(ev3.system.network()->brought(ev3.system.connections().at(0)));  // it is that host's own
    pi.part->speed.write({.vx = 0.2});
    pass(room, 3, ev3, pi, pc);
    REQUIRE_FALSE(ev3.part->targets.empty());
    CHECK(ev3.part->targets.back().data.vx == 0.2);
    CHECK(text(pc.ask(question(What::connect, "taget", from_pi()), ev3, pi)) ==
          "! host ev3: part has no in-port 'taget' (did you mean 'target'?)");
    CHECK(text(pc.ask(question(What::connect, "number", one(std::string("ev3/part.count"))), ev3, pi)) == "");
    CHECK(ev3.connections().back() == "part.count > part.number");  // both are ev3's
    CHECK(text(pc.ask(question(What::disconnect, "target", from_pi()), ev3, pi)) == "");
    pass(room, 3, ev3, pi, pc);
    CHECK(ev3.connections() == Lines{"part.count > part.number"});
    CHECK(pi.connections().empty());
}

TEST_CASE("a missing answer is reported after 2 s, and the request is not executed later", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    pass(room, 3, ev3, pi);
    room.domain.cut = true;
    const double begin = room.clock;
    CHECK(text(pi.ask(question(What::deactivate), ev3)) ==
          "! host ev3 has not answered for 2 s: the result is unknown");
    CHECK(room.clock - begin < 2.2);
    room.domain.cut = false;
    pass(room, 10, ev3, pi);
    CHECK(ev3.part->state() == LifeState::active);
}

TEST_CASE("a lost request is repeated and executed once", "[dds][network]") {
    Room room;
    HostRig ev3(room, "ev3"), pi(room, "pi");
    pass(room, 3, ev3, pi);
    room.domain.cut = true;
    const auto number = pi.system.network()->ask(question(What::deactivate));
    REQUIRE(number.has_value());
    room.domain.cut = false;
    room.clock += 0.3;
    pi.look();  // asks again
    room.domain.cut = true;
    ev3.look();  // its answer is lost
    CHECK(ev3.part->state() == LifeState::inactive);
    room.domain.cut = false;
    REQUIRE(ev3.part->activate(ev3.system.now()));
    for (int i = 0; i < 3; ++i) {
        room.clock += 0.3;
        pi.look();
        ev3.look();
    }
    pi.look();
    const auto answer = pi.system.network()->answer(*number);
    REQUIRE(answer.has_value());
    CHECK(text(*answer) == "INACTIVE");
    CHECK(ev3.part->state() == LifeState::active);
}

TEST_CASE("a recorded request is not executed again after its host was away", "[dds][network][secret]") {
    Room room;
    HostRig rig(room, "me");
    const auto place = room.domain.join(), others = room.domain.join();
    HostTable hosts({.protocol = protocol, .host = "me", .version = "1.0"}, 77);
    HostRequests requests(*place, "me", 77);
    int acts = 0;
    const auto serve = [&] {
        const auto act = [&](const Act& each, const Actor& who) {
            ++acts;
            return rig.act(each, who);
        };
        requests.serve(
            hosts,
            [&](const Question& asked, const Actor& who) {
                return answer_question({TreeNode(rig.system), rig.trace, act}, asked, true, who);
            },
            0);
        return acts;
    };
    Announcement pi;
    pi.head = {.protocol = protocol, .host = "pi", .version = "1.0"};
    pi.run = 5;
    hosts.heard(1, write_announcement(pi), 0);
    CHECK(serve() == 0);
    const auto writer = others->write(request_topic("me"));
    const auto ask = [&](std::uint64_t number, What what) {
        Octets bytes;
        write_cdr(bytes, {.order = std::endian::little, .header = true},
                  RemoteRequest{.from = 5,
                                .to = 77,
                                .number = number,
                                .what = static_cast<std::uint8_t>(what),
                                .component = "part",
                                .name = "",
                                .values = {}});
        writer->write(bytes);
        return serve();
    };
    CHECK(ask(1, What::deactivate) == 1);
    CHECK(ask(1, What::deactivate) == 1);
    hosts.keep({}, 1);
    CHECK(ask(1, What::deactivate) == 1);
    hosts.heard(2, write_announcement(pi), 2);
    CHECK(ask(1, What::deactivate) == 1);
    CHECK(ask(2, What::activate) == 2);
    CHECK(rig.part->state() == LifeState::active);
}
