// The object model of console and scenarios: what a component shows and does, seen from outside.
#include "bindings/lua/live/objects.hpp"

#include <catch2/catch.hpp>

#include "engine/tree/member.hpp"
#include "tests/unit/lua/objects_rig.hpp"

using namespace nezumi;

TEST_CASE("a port shows its value, stamp, age, type and peers, and reading consumes nothing", "[lua][objects]") {
    Objective it;
    CHECK(it.run("return controller.out.value.vx, controller.out.tm, controller.out.age, controller.out.stale") ==
          "0.0 0.0 inf true");
    it.tick(3);
    CHECK(it.run("return controller.out.value.vx, controller.out.tm, controller.out.type, controller.out.stale") ==
          "0.25 0.02 TimedVelocity2D false");
    CHECK(it.run("return controller.out.age") == "0.01");
    CHECK(it.run("return controller.out.peers[1], #controller.out.peers, controller.out.connected") ==
          "mouse.target_velocity_in 1 true");
    CHECK(it.run("return mouse.switch3bit_out.connected, mouse.ports.switch3bit_out.direction") == "false out");
    CHECK(it.run("return #controller.ports['in'].value, controller.ports['in'].path") == "4 controller.in");
    auto& in = *it.component("controller").find_in_port("in");
    in.inject(std::vector<std::int16_t>{1, 2});
    in.latch(it.live->system().now());
    CHECK(in.is_new());
    CHECK(it.run("return controller['in'].value[2], controller['in'].unread") == "2 true");
    CHECK(in.is_new());
}

TEST_CASE("every member has a type and documentation", "[lua][objects]") {
    for (const auto members : {component_members(), port_members()}) {
        for (const MemberInfo& member : members) {
            CAPTURE(member.name);
            CHECK_FALSE(member.doc.empty());
            CHECK_FALSE(member.type.empty());
            CHECK(member.called == member.type.starts_with("fun("));
        }
        CHECK(std::is_sorted(members.begin(), members.end(),
                             [](const MemberInfo& a, const MemberInfo& b) { return a.name < b.name; }));
    }
}

TEST_CASE("a real robot cannot be moved by teleport", "[lua][objects]") {
    Objective it;
    it.objects->set_hardware(true);
    CHECK(it.run("mouse:teleport { x = 0 }") ==
          "box.lua:1: teleport: this works only in simulation, and this run drives real robots");
}

TEST_CASE("an object survives a restart, and gives an error if its component is gone", "[lua][objects]") {
    Objective it;
    it.tick(5);
    CHECK(it.run("kept = controller.out return kept.tm") == "0.04");
    REQUIRE(it.live->act(Restart{}, {}).has_value());
    CHECK(it.run("return kept.tm, kept.path, kept == controller.out, kept == controller['in']") ==
          "0.0 controller.out true false");
    REQUIRE(it.live->act(Remove{"controller"}, {}).has_value());
    CHECK(it.run("return controller.status") == "box.lua:1: there is no component 'controller'");
    CHECK(it.run("return kept.value") == "box.lua:1: there is no component 'controller'");
    CHECK(it.run("return tostring(kept)") == "controller.out (there is no such port now)");
    CHECK(it.run("return tostring(controller)") == "controller (there is no such component now)");
}

TEST_CASE("the text of a component contains the about of its script", "[lua][objects]") {
    const auto shown = [](const std::string& about) {
        Objective it(counter_system, {{"counter", about + counter_behavior}});
        const std::string text = it.run("return tostring(controller)");
        return text.substr(0, text.find("\n  in "));
    };
    CHECK(shown("about { version = '1.2', vendor = 'Acme', category = 'driving' }") ==
          "controller  Counter, ACTIVE, version 1\n  about version 1.2, vendor Acme, category driving");
    CHECK(shown("about { vendor = 'Acme\\nand others' }") ==
          "controller  Counter, ACTIVE, version 1\n  about vendor Acme");
    CHECK(shown("about {}") == "controller  Counter, ACTIVE, version 1");
}
