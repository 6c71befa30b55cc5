// Driving a joystick's stick with the arrow keys.
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

TEST_CASE("the arrow keys move a joystick's stick, and both its ports follow", "[console][session][joystick]") {
    SessionRig it("component \"stick\" { type = \"Joystick\" }", {});
    CHECK(it.type("drive 'stick'") == "driving stick.stick: arrow keys, space stops, Esc ends");
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
