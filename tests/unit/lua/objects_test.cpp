// The object model of console and scenarios: what a component shows and does, seen from outside.
#include "bindings/lua/live/objects.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "engine/tree/member.hpp"
#include "tests/unit/lua/objects_rig.hpp"

using namespace nezumi;

TEST_CASE("a component shows its name, type, status and version", "[lua][objects]") {
    Objective it;
    CHECK(it.run("return controller.name, controller.type, controller.status, controller.version") ==
          "controller Counter ACTIVE 1");
    CHECK(it.run("return mouse.status, mouse.version, mouse.name") == "ACTIVE 1 mouse");
    CHECK(it.run("return controller.rate, controller.set, controller.error") == "100.0 nil nil");
    CHECK(it.run("return table.concat(controller.commands, ' '), table.concat(controller.sets, ' ')") ==
          "add fail both fast slow");
}

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

TEST_CASE("a name that is not there names the nearest", "[lua][objects]") {
    Objective it;
    CHECK(it.run("return controller.statsu") == "box.lua:1: controller has no 'statsu' (did you mean 'status'?)");
    CHECK(it.run("return controller.ports.ot") == "box.lua:1: controller has no port 'ot' (did you mean 'out'?)");
    CHECK(it.run("return world.contoller") ==
          "box.lua:1: there is no component 'contoller' (did you mean 'controller'?)");
    CHECK(it.run("return controller.config.sped_x") ==
          "box.lua:1: controller: unknown parameter 'sped_x' (did you mean 'speed_x'?)");
    CHECK(it.run("return controller.speed_x") ==
          "box.lua:1: controller has no 'speed_x': its parameter is controller.config.speed_x");
    CHECK(it.run("return controller.out.valu") == "box.lua:1: controller.out has no 'valu' (did you mean 'value'?)");
    CHECK(it.run("return controller.out[1]") ==
          "box.lua:1: controller.out is the port, not its value: its value is controller.out.value");
    CHECK(it.run("return mouse.truth.position") == "box.lua:1: mouse.truth has no 'position'");
    CHECK(it.run("return controller.collided") == "box.lua:1: controller has no 'collided'");
    CHECK(it.run("return controller[1]") == "box.lua:1: controller is a component: its members have names");
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

TEST_CASE("state is a copy that can't be changed", "[lua][objects]") {
    Objective it;
    CHECK(it.run("return controller.state.count, controller.state.list[2].deep") == "0 true");
    CHECK(it.run("controller.state.count = 3") ==
          "box.lua:1: can't set 'controller.state.count': 'controller.state' is a copy: a command of its script can "
          "change it");
    CHECK_THAT(it.run("controller.state.list[2].deep = false"),
               Catch::Contains("can't set 'controller.state.list[2].deep': 'controller.state.list[2]' is a copy"));
    CHECK(it.run("return mouse.state.any") == "nil");
}

TEST_CASE("a component is activated, deactivated, reset and switched from outside", "[lua][objects]") {
    Objective it;
    CHECK(it.run("return controller:deactivate(), controller.status") == "INACTIVE INACTIVE");
    CHECK(it.run("return controller:activate(), controller.status") == "ACTIVE ACTIVE");
    CHECK(it.run("controller:reset()") == "box.lua:1: controller is ACTIVE: only a component in ERROR can be reset");
    CHECK(it.run("controller:use 'fast' return controller.config.speed_x, controller.set") == "0.5 fast");
    CHECK(it.run("controller:use 'fsat'") ==
          "box.lua:1: controller has no parameter set 'fsat' (did you mean 'fast'?)");
    CHECK(it.run("controller.activate()") ==
          "box.lua:1: activate: write `X:activate(...)` with a colon, not `X.activate(...)`");
}

TEST_CASE("commands run in the component's own state, between ticks", "[lua][objects]") {
    Objective it;
    CHECK(it.run("return controller:add(2, 'b')") == "2 b");
    CHECK(it.run("return controller:add(3), controller.state.count") == "5 5");
    CHECK(it.run("controller:fail()").find("counter.lua:10: no luck") != std::string::npos);
    CHECK(
        it.run("controller:both()").find("output 'out' (TimedVelocity2D): field 'va' expected a number, got string") !=
        std::string::npos);
    CHECK(it.run("return controller.status") == "ACTIVE");
    CHECK(it.run("controller:add(print)") ==
          "box.lua:1: command 'add': argument 1 is a function, and only plain data can be given");
    CHECK_THAT(it.run("local t = {} for i = 1, 9999 do t[i] = i end controller:add(t)"),
               Catch::Contains("arithmetic"));  // it was given to the command
    CHECK(it.run("local t = {} for i = 1, 10000 do t[i] = i end controller:add(t)") ==
          "box.lua:1: command 'add' was given 10001 values: at most 10000, so that no tick is late");
    CHECK(it.run("controller:add(('x'):rep(1048577))") ==
          "box.lua:1: command 'add' was given 1048577 bytes of text: at most 1048576, so that no tick is late");
    CHECK(it.run("controller.add(1)") == "box.lua:1: add: write `X:add(...)` with a colon, not `X.add(...)`");
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

TEST_CASE("a wrong value gets the message that a script gets", "[lua][objects]") {
    Objective it;
    CHECK(it.run("controller.out:write { vx = 'x' }") ==
          "box.lua:1: output 'out' (TimedVelocity2D): field 'vx' expected a number, got string");
    CHECK(it.run("inject(controller['in'], { 1, 40000 })").find("box.lua:1: input 'in' (TimedShortSeq): element 2 ") ==
          0);
    CHECK(it.run("inject('controller.inn', {})") == "box.lua:1: controller has no port 'inn' (did you mean 'in'?)");
    CHECK(it.run("inject(controller, {})") ==
          "box.lua:1: expected a port, got the component controller: write controller.PORT");
    CHECK(it.run("inject()") == "box.lua:1: expected a port or \"name.port\", got nothing");
    CHECK(it.run("hold('controller.in')") == "box.lua:1: expected a value for controller.in");
    CHECK(it.run("inject('controller', {})") == "box.lua:1: 'controller' names no port: expected \"name.port\"");
}

TEST_CASE("setting a part of the truth is an error that says what to use", "[lua][objects]") {
    Objective it;
    CHECK_THAT(it.run("mouse.truth.pose.position.x = 3"),
               Catch::Contains("can't set 'mouse.truth.pose.position.x': 'mouse.truth.pose.position' is a copy: write "
                               "mouse:teleport { x =, y =, heading = }"));
    CHECK_THAT(it.run("mouse.truth.pose.heading = 1"),
               Catch::Contains("can't set 'mouse.truth.pose.heading': 'mouse.truth.pose' is a copy"));
    CHECK_THAT(it.run("mouse.truth.velocity.vx = 1"), Catch::Contains("mouse:disturb { vx =, vy =, va = }"));
    CHECK_THAT(it.run("mouse.truth.pose = { x = 1 }"),
               Catch::Contains("what is true can't be set: use teleport for the pose, disturb for the velocity"));
    CHECK(it.run("mouse:teleport(mouse.truth.pose) return mouse.truth.pose.position.x") == "0.0");
}

TEST_CASE("setting a port is an error that names it", "[lua][objects]") {
    Objective it;
    CHECK(it.run("controller.ports.zzz = 3") == "box.lua:1: zzz can't be set");
    CHECK(it.run("controller.ports[1] = 'zzz'") == "box.lua:1: what you name can't be set");
    CHECK_THAT(it.run("controller.ports.out.zzz = 3"), Catch::Contains("write a value with :write(value)"));
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

TEST_CASE("every member that a port is said to have is of the type that editors are told", "[lua][objects]") {
    Objective it;
    it.run("hold('controller.out', { vx = 0.1 })");
    for (const MemberInfo& member : port_members()) {
        if (member.type == "any") continue;
        const std::string_view type = member.type;
        const std::string expected = member.called                           ? "function"
                                     : type == "boolean"                     ? "boolean"
                                     : type == "number" || type == "integer" ? "number"
                                     : type.ends_with("[]")                  ? "table"
                                                                             : "string";
        CAPTURE(member.name);
        CHECK(it.run("return type(controller.out." + std::string(member.name) + ")") == expected);
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

TEST_CASE("what is nearer to zero than any measurement is shown as zero", "[lua][objects]") {
    Objective it;
    it.tick();
    CHECK(it.run("mouse:teleport { x = 1e-8, y = -1e-10, heading = 1e-12 } local pose = mouse.truth.pose "
                 "return pose.position.x > 0, pose.position.y, pose.heading") == "true 0.0 0.0");
    CHECK_THAT(it.run("return tostring(mouse.truth)"), Catch::Contains("y = 0 }, heading = 0 }\nvelocity"));
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

TEST_CASE("methods and words refuse an argument too many", "[lua][objects][bridge]") {
    Objective it;
    const std::vector<std::pair<std::string, std::string>> refusals{
        {"controller:activate(1)", "controller:activate: expected no arguments, got 1: controller:activate()"},
        {"controller:reset(nil)", "controller:reset: expected no arguments, got 1: controller:reset()"},
        {"controller:use('fast', 2)", "controller:use: expected at most 1 argument, got 2: controller:use \"SET\""},
        {"mouse:teleport({ x = 1 }, 2)", "mouse:teleport: expected at most 1 argument, got 2: mouse:teleport(pose)"},
        {"mouse:disturb({}, 2)",
         "mouse:disturb: expected at most 1 argument, got 2: mouse:disturb { vx =, vy =, va = }"},
        {"mouse:press('a', true, 3)", "mouse:press: expected at most 2 arguments, got 3: mouse:press(sensor, pressed)"},
        {"controller.out:write({}, 2)",
         "controller.out:write: expected at most 1 argument, got 2: controller.out:write(value)"},
        {"controller.out:hold({}, { take = true }, 3)",
         "controller.out:hold: expected at most 2 arguments, got 3: controller.out:hold(value, { take = true })"},
        {"controller.out:release(1)", "controller.out:release: expected no arguments, got 1: controller.out:release()"},
        {"mouse.teleport(controller, {})", "controller is no robot: it has no 'teleport'"},
    };
    for (const auto& [call, says] : refusals) {
        CAPTURE(call);
        CHECK(it.run(fmt::format("return select(2, pcall(function() {} end))", call)).find(says) != std::string::npos);
    }
}
