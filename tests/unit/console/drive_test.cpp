// Driving a joystick's stick with the arrow keys.
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Contains;

TEST_CASE("the arrow keys move a joystick's stick, and both ports publish it", "[console][session][joystick]") {
    SessionRig it("component \"stick\" { type = \"Joystick\" }", {});
    CHECK(it.type("drive 'stick'") ==
          "at full deflection: 150 px\ndriving stick.stick: arrow keys, + and - scale, space stops, Esc ends");
    const auto shows = [&](const std::string& pos, const std::string& vel) {
        it.turn(2);
        CHECK(it.type("stick.pos.value") == pos);
        CHECK(it.type("stick.vel.value") == vel);
    };
    it.session->key(Key::up);
    it.session->key(Key::up);
    shows("{ 0.0, 100.0 }", "{ 70.710678100586, 70.710678100586 }");
    it.session->key(Key::right);
    it.session->key(Key::right);
    shows("{ 100.0, 100.0 }", "{ 141.42135620117, 0.0 }");
    for (int i = 0; i < 5; ++i) it.session->key(Key::right);
    it.turn(2);
    CHECK(it.type("stick.pos.value") == "{ 150.0, 100.0 }");  // the edge of the pad
    it.session->key(Key::space);
    shows("{ 0.0, 0.0 }", "{ 0.0, 0.0 }");
    it.session->key(Key::left);
    it.turn(80);  // it springs back
    shows("{ 0.0, 0.0 }", "{ 0.0, 0.0 }");
    it.session->key(Key::escape);
    shows("{ 0.0, 0.0 }", "{ 0.0, 0.0 }");
    CHECK(it.component("stick").find_out_port("pos")->count() > 80);
}

TEST_CASE("driving ends when a reload removes the port or changes its type", "[console][session][joystick]") {
    const auto changed = GENERATE(as<std::string>{}, "function on_execute() end",
                                  "local out = output(\"out\", \"TimedShort\", \"a number\")");
    CAPTURE(changed);
    SessionRig it;
    CHECK(it.type("drive 'controller.out'") ==
          "at full deflection: 0.30 m/s, 3.0 rad/s\ndriving controller.out: arrow keys, + and - scale, space stops, "
          "Esc ends");
    CHECK(it.keys);
    it.session->key(Key::up);
    it.turn(2);
    it.folder.write("behaviors/counter.lua", changed);
    CHECK_THAT(it.type("reload()"), Contains("controller: version 2 runs"));
    it.shown.clear();
    it.turn();
    CHECK(it.shown == "the driven port is gone");
    CHECK_FALSE(it.keys);
    it.session->key(Key::up);
    it.turn(2);
    CHECK(it.shown == "the driven port is gone");  // said once
}

TEST_CASE("plus and minus change the speed of driving from the next tick, and show it", "[console][session]") {
    SessionRig it;
    it.type("drive 'mouse'");
    const auto velocity = [&] {
        it.turn(2);
        return it.type("mouse.target_velocity_in.value.vx");
    };
    const auto press = [&](Key key) {
        it.shown.clear();
        it.session->key(key);
        return it.shown;
    };
    CHECK(press(Key::up).empty());
    CHECK(velocity() == "0.1");
    CHECK(press(Key::faster) == "at full deflection: 0.45 m/s, 4.5 rad/s");
    CHECK(velocity() == "0.15");  // of the key that is held
    for (int i = 0; i < 9; ++i) press(Key::faster);
    CHECK(press(Key::faster) == "at full deflection: 0.90 m/s, 9.0 rad/s");
    for (int i = 0; i < 9; ++i) press(Key::slower);
    CHECK(press(Key::slower) == "at full deflection: 0.03 m/s, 0.3 rad/s");
    CHECK(velocity() == "0.01");
    press(Key::escape);
    CHECK(press(Key::faster).empty());
    it.turn(2);
    it.type("drive 'mouse'");
    CHECK(press(Key::slower) == "at full deflection: 0.21 m/s, 2.1 rad/s");  // as it was at first
}

TEST_CASE("the stick of a pad stays within its edge, with every scale", "[console][session][joystick]") {
    SessionRig it("component \"stick\" { type = \"Joystick\" }", {});
    it.type("drive 'stick'");
    it.shown.clear();
    it.session->key(Key::faster);
    CHECK(it.shown == "at full deflection: 150 px");
    it.session->key(Key::slower);
    for (int i = 0; i < 5; ++i) it.session->key(Key::up);
    it.turn(2);
    CHECK(it.type("stick.pos.value[2]") == "105.0");
}
