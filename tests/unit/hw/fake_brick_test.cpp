// The fake brick's motors and sensors behave as ev3dev's source says.
#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>

#include "tests/fakes/ev3_motor.hpp"
#include "tests/fakes/ev3_nodes.hpp"
#include "tests/fakes/ev3_sensor.hpp"

using namespace nezumi::fakes;

namespace {

// A large motor, plugged in.
Ev3Motor large_motor() {
    Ev3Motor motor(1050);
    motor.plug_in(10);
    return motor;
}

int put(Ev3Nodes& nodes, const std::string& name, std::string_view text) {
    std::uint64_t handle = 0;
    const int opened = nodes.open(name, handle);
    return opened != 0 ? opened : nodes.write(name, handle, text);
}

std::string get(Ev3Nodes& nodes, const std::string& name) {
    std::uint64_t handle = 0;
    std::string text;
    const int opened = nodes.open(name, handle);
    return opened != 0 || nodes.read(name, handle, text) != 0 ? "error" : text;
}

}  // namespace

TEST_CASE("a fake brick's motor accepts no speed above its maximum, and only numbers", "[hw][ev3][fakes]") {
    Ev3Motor motor = large_motor();
    CHECK(motor.read("max_speed", 10) == "1050\n");
    CHECK(motor.write("speed_sp", "1051", 10) == -EINVAL);
    CHECK(motor.write("speed_sp", "-1051", 10) == -EINVAL);
    for (const char* wrong : {"", " 5", "5.0", "fast"}) CHECK(motor.write("speed_sp", wrong, 10) == -EINVAL);
    CHECK(motor.read("speed_sp", 10) == "0\n");
    CHECK(motor.write("speed_sp", "-1050\n", 10) == 0);
    CHECK(motor.read("speed_sp", 10) == "-1050\n");
    CHECK(motor.write("time_sp", "-1", 10) == -EINVAL);
    CHECK(motor.write("stop_action", "halt", 10) == -EINVAL);
    CHECK(motor.write("command", "go", 10) == -EINVAL);
    CHECK(motor.write("max_speed", "2000", 10) == -EACCES);
}

TEST_CASE("a new speed of the fake EV3's motor takes effect with the next command", "[hw][ev3][fakes]") {
    Ev3Motor motor = large_motor();
    motor.write("speed_sp", "400", 10);
    CHECK(motor.rate(10) == 0);
    motor.write("command", "run-forever", 10);
    CHECK(motor.rate(10) == 400);
    motor.write("speed_sp", "-200", 11);
    CHECK(motor.rate(11) == 400);
    motor.write("command", "run-forever", 12);
    CHECK(motor.rate(12) == -200);
    CHECK(motor.read("state", 12) == "running\n");
}

TEST_CASE("a fake brick's run-timed ends by itself, and starts again when it is repeated", "[hw][ev3][fakes]") {
    Ev3Motor motor = large_motor();
    motor.write("stop_action", "hold", 10);
    motor.write("speed_sp", "400", 10);
    motor.write("time_sp", "200", 10);
    motor.write("command", "run-timed", 10);
    CHECK(motor.rate(10.19) == 400);
    motor.write("command", "run-timed", 10.19);
    CHECK(motor.rate(10.38) == 400);
    CHECK(motor.rate(10.4) == 0);
    CHECK(motor.mode(10.4) == Ev3Motor::Mode::hold);
    CHECK(motor.stopped_at(10.5) == Approx(10.39));
}

TEST_CASE("a fake brick's speed of zero means no power: the motor rolls and is not held", "[hw][ev3][fakes]") {
    Ev3Motor motor = large_motor();
    motor.write("stop_action", "hold", 10);
    motor.write("speed_sp", "400", 10);
    motor.write("command", "run-forever", 10);
    motor.write("speed_sp", "0", 11);
    motor.write("command", "run-forever", 11);
    CHECK(motor.mode(11) == Ev3Motor::Mode::roll);
    motor.write("command", "stop", 12);
    CHECK(motor.mode(12) == Ev3Motor::Mode::hold);
    motor.write("stop_action", "coast", 13);
    CHECK(motor.mode(13) == Ev3Motor::Mode::hold);  // like the speed, it takes effect with the next command
    motor.write("command", "stop", 13);
    CHECK(motor.mode(13) == Ev3Motor::Mode::roll);
}

TEST_CASE("a fake brick's position can't be written while the motor runs", "[hw][ev3][fakes]") {
    Ev3Motor motor = large_motor();
    motor.set_turned(90);
    CHECK(motor.read("position", 10) == "90\n");
    CHECK(motor.write("position", "0", 10) == 0);
    CHECK(motor.read("position", 10) == "0\n");
    motor.write("speed_sp", "400", 10);
    for (const char* command : {"run-forever", "run-to-abs-pos"}) {
        motor.write("command", command, 11);
        CHECK(motor.write("position", "7", 11) == -EBUSY);
        motor.write("command", "stop", 12);
    }
    CHECK(motor.write("position", "7", 12) == 0);
    motor.set_turned(100);
    CHECK(motor.read("position", 12) == "17\n");
}

TEST_CASE("a fake brick's sensor gives values of its old mode for 20 ms after a change", "[hw][ev3][fakes]") {
    Ev3Sensor sensor("lego-ev3-us");
    const Ev3Surroundings around{.distance = 1.0};
    CHECK(sensor.read("value0", around, 10) == "1000\n");
    CHECK(sensor.set_mode("US-DIST-PC", 10) == -EINVAL);
    REQUIRE(sensor.set_mode("US-DIST-IN\n", 10) == 0);
    CHECK(sensor.read("mode", around, 10) == "US-DIST-IN\n");
    CHECK(sensor.read("value0", around, 10.019) == "1000\n");
    CHECK(sensor.read("value0", around, 10.021) == "394\n");
}

TEST_CASE("a fake brick's change of mode takes time, and an unplugged device gives an error", "[hw][ev3][fakes]") {
    Ev3Nodes nodes;
    const std::string gyro = "sys/class/lego-sensor/sensor4/";
    REQUIRE(get(nodes, gyro + "address") == "ev3-ports:in2\n");
    const auto begin = std::chrono::steady_clock::now();
    CHECK(put(nodes, gyro + "mode", "GYRO-RATE") == 9);
    CHECK(std::chrono::steady_clock::now() - begin >= std::chrono::milliseconds(20));
    std::uint64_t handle = 0;
    std::string text;
    REQUIRE(nodes.open(gyro + "value0", handle) == 0);
    REQUIRE(nodes.unplug("in2"));
    CHECK(nodes.read(gyro + "value0", handle, text) == -ENODEV);
    CHECK(nodes.look(gyro + "value0") == -ENOENT);
    REQUIRE(nodes.plug_in("in2"));
    CHECK(get(nodes, gyro + "mode") == "error");  // its number is another one
    CHECK(get(nodes, "sys/class/lego-sensor/sensor8/mode") == "GYRO-ANG\n");
}
