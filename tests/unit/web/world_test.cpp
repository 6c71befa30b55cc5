// The world as shown to a browser, and moved by it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>

#include "engine/values/cdr.hpp"
#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

using Json = WebRig::Json;

// The next state of the first robot.
WebRobot next_robot(RawBrowser& browser) {
    for (;;) {
        const auto got = browser.next();
        REQUIRE(got);
        if (got->opcode != 2 || got->bytes[0] != 1) continue;
        const Octets bytes(got->bytes.begin() + 4, got->bytes.end());
        WebFrame frame;
        REQUIRE(read_cdr(bytes, {}, frame));
        if (!frame.robots.empty()) return frame.robots.front();
    }
}

Json move(const std::string& thing, double x, int id) {
    return {{"do", "act"},
            {"id", id},
            {"act", "MoveThing"},
            {"fields", {{"thing", thing}, {"pose", {{"position", {{"x", x}, {"y", 0}}}, {"heading", 0}}}}}};
}

}  // namespace

TEST_CASE("a browser moves a wall, and gets the reason if the place is not free", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto system = Json::parse(browser.next_text("\"is\":\"system\""));
    CHECK(system["arena"]["things"][0]["name"] == "box 1");
    CHECK(WebRig::answer(browser, move("box 1", 1.5, 1))["ok"] == true);
    CHECK(rig.live->system().world()->things().front().pose.position.x == 1.5);
    const auto refused = WebRig::answer(browser, move("box 1", 0, 2));
    CHECK(refused["ok"] == false);
    CHECK(refused["text"] == "box 1 at x = 0, y = 0 overlaps robot 'mouse': move one of them");
    rig.live->act(Restart{}, {});
    CHECK(rig.live->system().world()->things().front().pose.position.x == 0.8);
}

TEST_CASE("a browser gets a robot's tilt and the places and names of its contacts", "[web]") {
    WebRig rig(R"(
arena { box { at = { 0.4, 0, -0.02 }, size = { 0.8, 1, 0.1 }, pitch = -0.1 },
        box { at = { 0.5, 0, 0.3 }, size = { 0.02, 1, 0.6 } } }
robot "mouse" { model = "raspimouse", pose = { x = -0.1, y = 0, heading = 0 } }
)",
               {});
    rig.paused = false;
    REQUIRE(rig.live->act(Hold{"mouse.target_velocity_in", Velocity2D{.vx = 0.2}}, {}));
    RawBrowser browser = rig.open();
    REQUIRE(browser.send_frame(R"({"do":"watch","truth":true})"));
    const auto is_at_the_wall = [](const WebRobot& robot) {
        return std::any_of(robot.contacts.begin(), robot.contacts.end(),
                           [](const Point3D& at) { return std::abs(at.x - 0.49) < 0.01; });
    };
    WebRobot robot = next_robot(browser);
    CHECK(robot.contacts.empty());
    while (!is_at_the_wall(robot)) robot = next_robot(browser);
    // It bounces on arrival and climbs slightly while it pushes; which moment a browser sees depends on the machine.
    const auto is_tilted_up = [](const WebRobot& shown) { return shown.pitch < -0.05 && shown.pitch > -0.25; };
    for (int i = 0; i < 300 && !(is_at_the_wall(robot) && is_tilted_up(robot)); ++i) robot = next_robot(browser);
    CHECK(robot.collided);
    CHECK(robot.touches == "box 1");
    CHECK(is_tilted_up(robot));
    CHECK(robot.z > 0.01);
}

TEST_CASE("a browser gets the port with the value of each ray", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto robot = Json::parse(browser.next_text("\"is\":\"system\""))["robots"][0];
    REQUIRE(robot["distances"].size() == 4);
    std::map<std::string, int> places;  // in the port's message
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(robot["distances"][i]["port"] == "ir_sensor_out");
        places[robot["sensors"][i]["name"]] = robot["distances"][i]["index"];
    }
    CHECK(places ==
          std::map<std::string, int>{{"right_front", 0}, {"right_side", 1}, {"left_side", 2}, {"left_front", 3}});
}
