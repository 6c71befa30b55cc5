// The EV3's driver on fake nodes that behave like ev3dev, with simulated physics.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "engine/world/floor_color.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

constexpr double degree = std::numbers::pi / 180;

// Writes one device of a class into a folder of plain files.
void put_motor(const Scratch& folder, const std::string& number, const std::string& port, const std::string& driver) {
    const std::string motor = "class/tacho-motor/motor" + number + "/";
    folder.write(motor + "address", "ev3-ports:" + port + "\n");
    folder.write(motor + "driver_name", driver + "\n");
    folder.write(motor + "max_speed", "1050\n");
    folder.write(motor + "count_per_rot", "360\n");
    folder.write(motor + "position", "0\n");
    for (const char* node : {"command", "speed_sp", "time_sp", "stop_action"}) folder.write(motor + node, "untouched");
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("an EV3 without one of its wheels' motors is refused, and the other motor is unchanged",
          "[hw][ev3][safety]") {
    const RobotSpec spec = ev3_spec();
    const Scratch folder;
    const std::string classes = folder.path("class/tacho-motor").string();
    const auto refusal = [&] {
        const auto body = Ev3Body::make(spec, {.dev = "", .sys = folder.path("").parent_path().string()});
        REQUIRE_FALSE(body);
        return body.error().message;
    };
    CHECK(refusal() == "motors: " + classes + ": no such file or directory: is this an EV3 brick with ev3dev?");
    put_motor(folder, "4", "outB", "lego-ev3-l-motor");
    CHECK(refusal() == "motors: nothing is plugged in at outC, expected a lego-ev3-l-motor: look at its cable");
    put_motor(folder, "0", "outC", "lego-ev3-m-motor");
    CHECK(refusal() ==
          "motors: a lego-ev3-m-motor is plugged in at outC, expected a lego-ev3-l-motor: change their cables, or set "
          "port = ... in the robot file");
    for (const char* node : {"command", "speed_sp", "time_sp", "stop_action"})
        CHECK(text_of(folder.path(std::string("class/tacho-motor/motor4/") + node)) == "untouched");
}

TEST_CASE("an EV3's motors are at the ports of its robot file", "[hw][ev3]") {
    RobotSpec spec = ev3_spec();
    spec.drive.port = {"outD", "outA"};
    spec.actuators.clear();
    const Scratch folder;
    put_motor(folder, "1", "outA", "lego-ev3-l-motor");
    put_motor(folder, "2", "outD", "lego-ev3-l-motor");
    for (const char* motor : {"1", "2"}) {
        for (const char* node : {"ramp_up_sp", "ramp_down_sp", "polarity"})
            folder.write(std::string("class/tacho-motor/motor") + motor + "/" + node, "");
    }
    const DeviceRoots roots{.dev = "", .sys = folder.path("").parent_path().string()};
    auto body = Ev3Body::make(spec, roots);
    REQUIRE(body);
    (*body)->set_motor_power(true);
    std::string written;      // empty while the driver's thread writes it
    const auto turns = [&] {  // after the guard has proved that it can stop them
        (*body)->set_wheel_speeds({.left = -360 * degree * spec.drive.radius, .right = 0});
        written = text_of(folder.path("class/tacho-motor/motor2/speed_sp"));
        return text_of(folder.path("class/tacho-motor/motor2/command")) == "run-timed" && !written.empty();
    };
    REQUIRE(FakeRobot::wait_until(turns, 2));
    const double speed = std::stod(written);
    CHECK(speed < 0);
    CHECK(speed >= -360);
    const auto second = Ev3Body::make(spec, roots);
    REQUIRE_FALSE(second);
    CHECK(second.error().message.find("another robot of this system drives these motors already") != std::string::npos);
    body->reset();
    CHECK(text_of(folder.path("class/tacho-motor/motor2/command")) == "stop");
}

TEST_CASE("a robot file that the driver ev3 can't serve is refused", "[hw][ev3]") {
    const auto refusal = [](const RobotSpec& spec) {
        const auto body = Ev3Body::make(spec, {});
        return body ? "" : body.error().message;
    };
    RobotSpec two_arms = ev3_spec();
    two_arms.actuators.push_back(two_arms.actuators.front());
    for (ActuatorSpec& actuator : two_arms.actuators) actuator.kind = ActuatorSpec::Kind::servo;
    CHECK(refusal(two_arms).find("the driver ev3 has one servo, but model 'ev3' needs ") == 0);
    RobotSpec same_port = ev3_spec();
    for (SensorSpec& sensor : same_port.sensors) {
        if (sensor.name == "left") sensor.port = "in3";
    }
    CHECK(refusal(same_port).find("the driver ev3 can't tell 'left' and 'right' of model 'ev3' apart: give each a port "
                                  "= \"in1\" to \"in4\" of its own") == 0);
    RobotSpec one_wheel = ev3_spec();
    one_wheel.drive.port = {"outB"};
    CHECK(refusal(one_wheel) == "drive.port of model 'ev3': expected two, the left motor's and the right's, got 1");
}

TEST_CASE("a gyro's angle continues over its wrap and after it was unplugged", "[hw][ev3]") {
    GyroAngle gyro;
    const auto says = [&](int degrees, int plugged_in) {
        return std::round(gyro.take({.values = {static_cast<double>(degrees)}, .plugged_in = plugged_in}) / degree);
    };
    CHECK(says(32700, 1) == 0);
    CHECK(says(-32736, 1) == -100);  // clockwise, 65536 on
    CHECK(says(0, 2) == -100);       // its zero is the position where it was plugged in again
    CHECK(says(-30, 2) == -70);
}

TEST_CASE("raw RGB values are converted to the nearest colour name", "[hw][ev3]") {
    const auto name = [](std::array<double, 3> raw) {
        const auto seen = floor_seen({.values = raw, .plugged_in = 1});
        return to_text(seen ? nearest_floor_color(*seen) : FloorColor::none);
    };
    CHECK(name({300, 310, 290}) == "white");
    CHECK(name({25, 30, 20}) == "black");
    CHECK(name({200, 30, 25}) == "red");
    CHECK(name({20, 90, 40}) == "green");
    CHECK(name({20, 60, 140}) == "blue");
    CHECK(name({280, 220, 40}) == "yellow");
    CHECK(name({3, 4, 2}) == "none");
    CHECK(brightness(*floor_seen({.values = {600, 400, 300}})) == Approx(100));
}

TEST_CASE("a picture is scaled to the brick's screen, with 32 bits or one per pixel", "[hw][ev3]") {
    CameraImage picture{
        .width = 2, .height = 1, .bpp = 24, .format = "rgb8", .fDiv = 0, .pixels = {255, 0, 0, 0, 0, 255}};
    const std::string frame = paint_screen(picture, {});
    REQUIRE(frame.size() == 712 * 128);
    const auto pixel = [&](int x, int y) {
        const auto* at = reinterpret_cast<const unsigned char*>(frame.data()) + y * 712 + 4 * x;
        return at[2] << 16 | at[1] << 8 | at[0];
    };
    CHECK(pixel(0, 64) == 0xff0000);
    CHECK(pixel(88, 64) == 0xff0000);
    CHECK(pixel(89, 64) == 0x0000ff);
    CHECK(pixel(177, 64) == 0x0000ff);
    CHECK(pixel(0, 18) == 0xffffff);  // 89 rows of picture, white above and below
    CHECK(pixel(0, 19) == 0xff0000);
    CHECK(pixel(0, 108) == 0xffffff);

    picture = {.width = 2, .height = 2, .bpp = 8, .format = "gray8", .fDiv = 0, .pixels = {0, 255, 255, 0}};
    const std::string bits = paint_screen(picture, {.bits_per_pixel = 1, .stride = 24});
    REQUIRE(bits.size() == 24 * 128);
    CHECK(bits[24 * 10 + 5] == '\xff');  // columns 40 to 47, dark
    CHECK(bits[24 * 10 + 3] == '\xfe');  // its first column is 25
    CHECK(bits[24 * 10 + 15] == '\x00');
    picture.bpp = 16;
    CHECK(paint_screen(picture, {}).empty());
}

TEST_CASE("a sensor of an EV3 that stays in another mode is reported with that mode and used again",
          "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    REQUIRE(ev3.idle(3, [&] { return ev3.speaks("gyro"); }));
    fake.fault("in2/mode", "garbage");
    CHECK(ev3.idle(3, [&] { return ev3.said("/mode: expected GYRO-G&A, got 'what?' again and again: "); }));
    CHECK_FALSE(ev3.speaks("gyro"));
    fake.fault("in2/mode", "none");
    CHECK(ev3.idle(3, [&] { return ev3.speaks("gyro"); }));
    INFO(ev3.all_log());
    CHECK(ev3.log.size() == 1);
}

TEST_CASE("an EV3's battery that does not answer is reported", "[hw][ev3][fakes][wallclock]") {
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    ev3.idle(0.5);
    fake.fault("battery", "hang");
    CHECK(ev3.idle(3, [&] { return ev3.said("battery: no answer for 0.3 s: restart its driver, or the robot"); }));
    CHECK(std::isnan(ev3.robot->battery().value()));
    fake.fault("battery", "none");
    CHECK(ev3.idle(4, [&] { return ev3.said("battery: back again"); }));
}
