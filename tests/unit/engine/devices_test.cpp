// A robot's eyes for the floor, its screen and its speaker.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/unit/engine/fake_world.hpp"

using namespace nezumi;

namespace {

PortSpec port(const char* name, const char* type, std::vector<std::string> items, bool is_input) {
    PortSpec made;
    made.name = name;
    made.type = type;
    made.items = std::move(items);
    made.is_input = is_input;
    return made;
}

// The fake mouse with what an EV3 has besides.
RobotSpec brick() {
    RobotSpec spec = fake_mouse();
    SensorSpec color;
    color.name = "color";
    color.kind = SensorSpec::Kind::color;
    SensorSpec light;
    light.name = "light_below";
    light.kind = SensorSpec::Kind::reflect;
    spec.sensors.push_back(color);
    spec.sensors.push_back(light);
    spec.actuators[2].max_rate = 2;
    spec.actuators.push_back({.name = "screen", .kind = ActuatorSpec::Kind::screen});
    spec.actuators.push_back({.name = "speaker", .kind = ActuatorSpec::Kind::speaker});
    spec.ports.push_back(port("color", "TimedString", {"color"}, false));
    spec.ports.push_back(port("colors", "TimedStringSeq", {"color", "color"}, false));
    spec.ports.push_back(port("code", "TimedShort", {"color"}, false));
    spec.ports.push_back(port("reflect", "TimedDouble", {"light_below"}, false));
    spec.ports.push_back(port("lcd", "CameraImage", {"screen"}, true));
    spec.ports.push_back(port("sound", "TimedString", {"speaker"}, true));
    spec.ports.back().queue = 4;
    return spec;
}

std::string refusal(const PortSpec& wrong) {
    RobotSpec spec = brick();
    std::erase_if(spec.ports, [](const PortSpec& p) { return p.name == "sound" || p.name == "lcd"; });
    spec.ports.push_back(wrong);
    const auto robot = Robot::make("m", spec, {});
    return robot ? "none" : robot.error().message;
}

CameraImage picture(std::uint16_t width, std::uint16_t height, std::size_t bytes) {
    return {.width = width, .height = height, .bpp = 8, .format = "gray8", .fDiv = 1, .pixels = Octets(bytes)};
}

}  // namespace

TEST_CASE("a port for a quantity that its sensor does not have is refused", "[engine][sensor]") {
    PortSpec wrong = port("p", "TimedDouble", {"light_below"}, false);
    wrong.quantity = PortSpec::Quantity::rate;
    CHECK(refusal(wrong) == "port 'p': 'light_below' is not a gyro: it has no rate");
    wrong.quantity = PortSpec::Quantity::distance;
    CHECK(refusal(wrong) == "port 'p': 'light_below' is not a range sensor: it has no distance");
    CHECK(refusal(port("p", "RangeData", {"light_below"}, false)) ==
          "port 'p': 'light_below' is not a range sensor: it has no distance");
}

TEST_CASE("a colour sensor's ports give the colour's name or its code", "[engine][sensor]") {
    FakeRun run(brick());
    run.system.tick();
    CHECK(run.value<std::string>("color") == "none");
    run.hull().color = FloorColor::brown;
    run.system.tick();
    CHECK(run.value<std::string>("color") == "brown");
    CHECK(run.value<std::vector<std::string>>("colors") == std::vector<std::string>{"brown", "brown"});
    CHECK(run.value<std::int16_t>("code") == 7);
}

TEST_CASE("a servo is sent to its angle once, at the speed of its parameter", "[engine][robot]") {
    RobotSpec spec = brick();
    spec.actuators[2].speed = 1.6;
    FakeRun run(spec);
    CHECK(run.robot->parameters().find("neck_speed")->value == Value(1.6));
    run.send("neck_in", 0.05);
    CHECK(run.hull().servos[2] == 0.05);
    CHECK(run.hull().servo_speeds[2] == 1.6);
    REQUIRE(run.robot->parameters().stage("neck_speed", Value(0.5)));
    run.send("neck_in", -5.0);  // beyond its limit
    CHECK(run.hull().servos[2] == -1.0);
    CHECK(run.hull().servo_speeds[2] == 0.5);
    CHECK(run.robot->parameters().stage("neck_speed", Value(2.5)).error().message ==
          "parameter 'neck_speed' (number): 2.5 is above its maximum 2.0");
    run.hull().servos[2] = 0.3;  // on its way
    REQUIRE(run.robot->deactivate(run.system.now()));
    run.ticks(2);
    CHECK(run.hull().servos[2] == 0.3);  // where it is, it stays
    CHECK(FakeRun(brick()).robot->parameters().all().empty());
}

TEST_CASE("the message of a range sensor on a servo has the direction of the sensor", "[engine][sensor]") {
    RobotSpec spec = brick();
    spec.actuators[2].at = {0.05, 0, 0.04};
    spec.actuators[2].minimum = spec.actuators[2].maximum = 0;
    spec.actuators[2].max_rate = 0;
    spec.sensors[0].on = "neck";
    spec.sensors[0].at = {0.07, 0, 0.05};
    spec.sensors[0].yaw = 0.1;
    FakeRun run(spec);
    run.system.tick();
    CHECK(run.value<RangeData>("ranger").geometry.pose.orientation.y == 0.1);
    CHECK(run.value<RangeData>("ranger").geometry.pose.position.x == Approx(0.07));
    run.send("neck_in", std::acos(0.0));
    run.system.tick();
    const Pose3D pose = run.value<RangeData>("ranger").geometry.pose;
    CHECK(pose.orientation.y == Approx(0.1 + std::acos(0.0)));
    CHECK(pose.position.x == Approx(0.05));
    CHECK(pose.position.y == Approx(0.02));
    CHECK(pose.position.z == Approx(0.05));
}

TEST_CASE("a speaker plays every text of a tick and keeps what it was given", "[engine][robot]") {
    FakeRun run(brick());
    const std::string odd = "it's \"odd\"; $(rm -rf /)\n`reboot` | & <b>";
    auto* in = run.robot->find_in_port("sound");
    for (const std::string& text : {std::string("beep"), std::string("tone,880,250"), odd}) in->inject(text);
    run.system.tick();
    REQUIRE(run.hull().sounds.size() == 3);
    CHECK(run.hull().sounds[0].kind == Sound::Kind::tone);
    CHECK(run.hull().sounds[1].hertz == 880);
    CHECK(run.hull().sounds[1].seconds == 0.25);
    CHECK(run.hull().sounds[2].kind == Sound::Kind::speech);
    CHECK(run.hull().sounds[2].text == odd);
    CHECK(std::vector<std::string>(run.robot->said().begin(), run.robot->said().end()) ==
          std::vector<std::string>{"beep", "tone,880,250", odd});
    for (int i = 0; i < 150; ++i) run.send("sound", std::string("again"));
    CHECK(run.robot->said().size() == Actuators::most_said);
    CHECK(run.hull().sounds.size() == 153);
}

TEST_CASE("a screen shows whole pictures, and says once why not the others", "[engine][robot]") {
    FakeRun run(brick());
    run.send("lcd", picture(0, 0, 0));
    run.send("lcd", picture(4, 2, 7));
    CHECK(run.hull().pictures.empty());
    CHECK(run.log ==
          std::vector<std::string>{
              "mouse: input 'lcd': can't show a picture of 0 x 0 pixels with 8 bits per pixel and 0 bytes "
              "(reported once): expected width, height and bpp (bits per pixel, 24 for rgb8) greater than 0"});
    run.send("lcd", picture(4, 2, 8));
    REQUIRE(run.hull().pictures.size() == 1);
    CHECK(run.hull().pictures[0].width == 4);
}

TEST_CASE("a port of a screen, a speaker or a colour sensor with a wrong type or option is an error",
          "[engine][robot]") {
    CHECK(refusal(port("p", "TimedString", {"screen"}, true)) ==
          "port 'p': 'screen' takes a CameraImage, not a TimedString");
    CHECK(refusal(port("p", "TimedShort", {"speaker"}, true)) ==
          "port 'p': 'speaker' takes a TimedString, not a TimedShort");
    CHECK(refusal(port("p", "TimedString", {"gyro"}, false)) ==
          "port 'p': a TimedString carries colours, and 'gyro' is not a color sensor");
    PortSpec off = port("p", "TimedString", {"speaker"}, true);
    off.off_when_silent = true;
    CHECK(refusal(off) ==
          "port 'p': silence = \"off\" has no meaning for the speaker 'speaker': it is silent after each text");
    off = port("p", "CameraImage", {"screen"}, true);
    off.off_when_silent = true;
    CHECK(refusal(off) ==
          "port 'p': silence = \"off\" has no meaning for the screen 'screen': it keeps its last picture");
}

TEST_CASE("a text is a beep, a tone of two whole numbers, or to be spoken", "[engine][sound]") {
    const auto kind = [](std::string_view text) { return read_sound(text).kind; };
    CHECK(read_sound("beep").hertz == 440);
    CHECK(read_sound("beep").seconds == 0.2);
    CHECK(read_sound("tone,1000,500").hertz == 1000);
    CHECK(read_sound("tone,1000,500").seconds == 0.5);
    CHECK(read_sound("tone,0,500").hertz == 0);
    CHECK(read_sound("tone,99999999999999999999,99999999").hertz == highest_tone);
    CHECK(read_sound("tone,99999,99999999").seconds == longest_tone / 1000.0);
    for (const char* text : {"tone", "tone,", "tone,440", "tone,440,", "tone,,100", "tone,-1,100", "tone,440,100,1",
                             "tone,4.5,100", "tone,4 40,100", "Beep", "be ep", "hello, world", "-w /etc/passwd"}) {
        INFO(text);
        CHECK(kind(text) == Sound::Kind::speech);
        CHECK(read_sound(text).text == text);
    }
    // Blanks count for nothing.
    CHECK(kind(" beep\n") == Sound::Kind::tone);
    CHECK(read_sound("tone, 440 , 100 ").hertz == 440);
    CHECK(read_sound("tone, 440 , 100 ").seconds == 0.1);
    CHECK(read_sound("  good morning\t").text == "good morning");
    CHECK(kind("") == Sound::Kind::nothing);
    CHECK(kind(" \n\t ") == Sound::Kind::nothing);
}
