// The object model of console and scenarios: what a component shows and does, seen from outside.
#include "bindings/lua/live/objects.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "engine/tree/member.hpp"
#include "tests/unit/lua/objects_rig.hpp"

using namespace nezumi;

TEST_CASE("a port shows its value, stamp, age, type and peers, and nothing is consumed", "[lua][objects]") {
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

TEST_CASE("parameters are read and written within their bounds", "[lua][objects]") {
    Objective it;
    CHECK(it.run("controller.config.speed_x = 0.5 return controller.config.speed_x") == "0.5");
    it.tick();
    CHECK(it.run("return controller.out.value.vx") == "0.5");
    CHECK(it.run("controller.config.speed_x = 9") ==
          "box.lua:1: parameter 'speed_x' (number): 9.0 is above its maximum 1.5");
    CHECK(it.run("controller.config.stop_d = 'x'").find("box.lua:1: parameter 'stop_d' (integer)") == 0);
    CHECK(it.run("controller.config.sped_x = 1") ==
          "box.lua:1: controller: unknown parameter 'sped_x' (did you mean 'speed_x'?)");
    CHECK(it.run("local t = {} for name, value in pairs(controller.config) do t[#t + 1] = name end "
                 "return table.concat(t, ' ')") == "gains speed_x stop_d");
    CHECK(it.run("controller.config.gains = { 2, 3 } return controller.config.gains[2]") == "3.0");
    CHECK(it.run("controller.config.gains[1] = 7") ==
          "box.lua:1: can't set 'controller.config.gains[1]': 'controller.config.gains' is a copy: write all of it, "
          "controller.config.gains = { ... }");
    CHECK(it.run("controller.speed_x = 1") ==
          "box.lua:1: controller.speed_x can't be set: its parameter is controller.config.speed_x");
    CHECK(it.run("controller.out = 1") ==
          "box.lua:1: controller.out is a port: write a value with controller.out:write(value)");
}

TEST_CASE("a value is written, injected, held and released from outside", "[lua][objects]") {
    Objective it;
    it.tick(2);
    CHECK(it.run("inject('controller.in', { 31 })").empty());
    it.tick();
    CHECK(it.run("return controller.out.value.vx") == "0.0");  // it came after the sensors' message
    it.tick();
    CHECK(it.run("return controller.out.value.vx") == "0.25");
    CHECK(it.run("hold(controller['in'], { 31, 0 }) return controller['in'].override") == "held");
    it.tick();
    CHECK(it.run("return controller.out.value.vx, controller['in'].value[1]") == "0.0 31");
    CHECK(it.run("release 'controller.in' return controller['in'].override").empty());
    it.tick();
    CHECK(it.run("return controller.out.value.vx") == "0.25");
    CHECK(it.run("controller:deactivate()").empty());
    it.tick();
    CHECK(it.run("controller.out:write { vx = 0.125 }").empty());
    it.tick();
    CHECK(it.run("return mouse.target_velocity_in.value.vx") == "0.125");
    CHECK(it.run("mouse.buzzer_hz_in:write(440)").empty());
    it.tick();
    CHECK(it.run("return mouse.buzzer") == "440");
}

TEST_CASE("every member says what it is", "[lua][objects]") {
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

TEST_CASE("probes are seen from outside, with their time and age", "[lua][objects]") {
    Objective it(
        counter_system,
        {{"counter",
          "local range = input('in', 'TimedShortSeq') local out = output('out', "
          "'TimedVelocity2D') param('speed_x', 0.1)\nfunction on_execute() if now() < 0.05 then probe('error', "
          "now()) end probe('flat', { 1, two = 'x' }) end"}});
    CHECK(it.run("return next(controller.probes) == nil, controller.probes.error") == "true nil");
    it.tick(10);
    CHECK(it.run(
              "local e = controller.probes.error return e.value == e.tm, e.tm < 0.05, ('%.2f'):format(e.tm + e.age)") ==
          "true true 0.10");
    CHECK(it.run("return controller.probes.flat.value[1], controller.probes.flat.value.two") == "1 x");
    CHECK(it.run("controller.probes.error = 1") ==
          "box.lua:1: can't set 'controller.probes.error': 'controller.probes' is a copy: its script shows them");
    CHECK_THAT(it.run("return tostring(controller)"), Catch::Contains("\n  probe flat = { 1, two = \"x\" }"));
    CHECK(it.run("return next(mouse.probes) == nil") == "true");
}

TEST_CASE("a robot shows the truth, its lights and its limits, and can be carried", "[lua][objects]") {
    Objective it;
    it.tick(50);
    CHECK(it.run("return mouse.truth.pose.position.x > 0.01, mouse.truth.velocity.vx > 0.1, mouse.collided") ==
          "true true false");
    CHECK(it.run("mouse:teleport { x = -0.5, heading = 1 } return mouse.truth.pose.position.x, "
                 "mouse.truth.pose.heading") == "-0.5 1.0");
    CHECK(it.run("return mouse.limits.speed, #mouse.leds, mouse.buzzer") == "0.5 4 0");
    for (const auto& [given, kind] :
         {std::pair<std::string, std::string>{"'no'", "string"}, {"1", "number"}, {"{}", "table"}})
        CHECK(it.run("mouse:press('switch1', " + given + ")") ==
              "box.lua:1: press: expected true or false, got " + kind);
    CHECK(it.run("mouse:press('switch1')").empty());
    it.tick();
    CHECK(it.run("return mouse.switch3bit_out.value[2]") == "true");
    CHECK(it.run("mouse:press('switch9')").find("box.lua:1: mouse has no button 'switch9' (did you mean 'switch") == 0);
    CHECK(it.run("mouse:teleport { x = 0, z = 1 }").find("box.lua:1: pose: unknown field 'z'") == 0);
    it.objects->set_hardware(true);
    CHECK(it.run("mouse:teleport { x = 0 }") == "box.lua:1: teleport: this is a real robot");
}

TEST_CASE("an object stays valid over a restart, and says so when its component is gone", "[lua][objects]") {
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

TEST_CASE("objects have a text that a person can read", "[lua][objects]") {
    Objective it;
    it.tick(2);
    CHECK(it.run("return tostring(controller.out)") ==
          "controller.out  TimedVelocity2D  { vx = 0.25, vy = 0, va = 0 }  0.01 s old  -> mouse.target_velocity_in");
    it.run("hold(controller.out, {})");
    CHECK(it.run("return tostring(controller)") ==
          "controller  Counter, ACTIVE, version 1\n"
          "  in  in   TimedShortSeq    <- mouse.ir_sensor_out\n"
          "  out out  TimedVelocity2D  -> mouse.target_velocity_in  held by console at { vx = 0, vy = 0, va = 0 }\n"
          "  config.speed_x = 0.25\n"
          "  config.stop_d = 30\n"
          "  config.gains = { 1.0, 0.5 }\n"
          "  :add(...)  counts up\n"
          "  :fail(...)  \n"
          "  :both(...)  ");
    CHECK(it.run("return tostring(controller.config)") ==
          "speed_x = 0.25  m/s, -1.5 to 1.5  straight-ahead speed\nstop_d = 30\ngains = { 1.0, 0.5 }");
    CHECK(it.run("local n = 0 for name, port in pairs(controller.ports) do n = n + #port.path end return n") == "27");
}

TEST_CASE("what a behaviour says about itself is shown where it is", "[lua][objects]") {
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
