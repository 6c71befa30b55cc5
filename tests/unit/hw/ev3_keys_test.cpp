// The brick's keys on the fake brick.
#include <catch2/catch.hpp>
#include <fstream>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

const SensorReading& key(const DrivenEv3& ev3, std::string_view name) {
    for (std::size_t i = 0; i < ev3.spec.sensors.size(); ++i) {
        if (ev3.spec.sensors[i].name == name) return ev3.robot->readings()[i];
    }
    throw std::runtime_error("no such key");
}

}  // namespace

TEST_CASE("each key of an EV3 is read separately", "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    ev3.idle(0.1);
    for (const std::string_view pressed : brick_keys) {
        REQUIRE(fake.say("key " + std::string(pressed) + " 1").empty());
        CHECK(ev3.idle(1, [&] { return key(ev3, "key_" + std::string(pressed)).value == 1; }));
        for (const std::string_view other : brick_keys) {
            if (other != pressed) CHECK(key(ev3, "key_" + std::string(other)).value == 0);
        }
        fake.say("key " + std::string(pressed) + " 0");
        CHECK(ev3.idle(1, [&] { return key(ev3, "key_" + std::string(pressed)).value == 0; }));
    }
}

TEST_CASE("failed keys of an EV3 are reported once and used again", "[hw][ev3][fakes][threads][wallclock]") {
    const auto [fault, why] = GENERATE(table<std::string, std::string>({
        {"missing", "no such device: is this an EV3 brick with ev3dev?"},
        {"eio", "input/output error: is this an EV3 brick with ev3dev?"},
        {"hang", "no answer for 0.3 s: restart its driver, or the robot"},
    }));
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    REQUIRE(ev3.idle(1, [&] { return key(ev3, "key_up").is_there; }));
    fake.fault("keys", fault);
    INFO(fault);
    CHECK(ev3.idle(2, [&] { return !key(ev3, "key_up").is_there && ev3.said("keys: "); }));
    CHECK(ev3.said(why));
    ev3.idle(0.6);
    INFO(ev3.all_log());
    CHECK(ev3.log.size() == 1);
    fake.say("heal");
    CHECK(ev3.idle(2, [&] { return key(ev3, "key_up").is_there; }));
    CHECK(ev3.idle(5, [&] { return ev3.said("keys: back again"); }));
}

TEST_CASE("a button that is not a key of the brick is refused with a list of the keys", "[hw][ev3]") {
    RobotSpec spec = ev3_spec();
    for (SensorSpec& sensor : spec.sensors) {
        if (sensor.name == "key_back") sensor.port = "escape";
    }
    const auto body = Ev3Body::make(spec, {});
    REQUIRE_FALSE(body);
    CHECK(
        body.error().message ==
        "sensor 'key_back' of model 'ev3': port: expected a key of the brick, up, down, left, right, enter, back, got "
        "'escape'");
}

TEST_CASE("an EV3 with a start button waits for the brick's key", "[hw][ev3][run][fakes][safety][wallclock]") {
    FakeEv3 fake;
    fake.folder.write("behaviors/ahead.lua",
                      "local out = output('out', 'TimedVelocity2D', 'velocity')\n"
                      "function on_execute() out:write { vx = 0.2 } end\n");
    std::ifstream shipped(FakeRobot::robot_file("ev3"));
    std::string model((std::istreambuf_iterator<char>(shipped)), {});
    const std::string plain = "driver = \"ev3\"";
    model.replace(model.find(plain), plain.size(), plain + ", start = \"key_enter\"");
    fake.folder.write("behaviors/waiting_ev3.lua", model);
    fake.folder.write("system.lua",
                      "robot 'ev3' { model = 'waiting_ev3' }\n"
                      "behavior 'driver' { script = 'ahead' }\nconnect('driver.out', 'ev3.velocity2D')\n");
    Program program(
        {"run", "system.lua", "--hw", "--headless", "--dev-root", fake.roots().dev, "--sys-root", fake.roots().sys},
        fake.folder.path("").string());
    REQUIRE(program.wait_for_error("ev3 WAITS: PRESS key_enter ON THE ROBOT", 20));
    fake.say("key back 1");
    sleep_for(0.5);
    CHECK_FALSE(fake.moves());
    fake.say("key enter 1");
    CHECK(program.wait_for_error("ev3 starts", 5));
    CHECK(FakeEv3::wait_until([&] { return fake.moves(); }, 5));
}
