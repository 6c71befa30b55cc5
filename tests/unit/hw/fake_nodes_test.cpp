// The fake mouse's nodes behave as the driver's source says.
#include "tests/fakes/mouse_nodes.hpp"

#include <catch2/catch.hpp>
#include <cerrno>

using namespace nezumi::fakes;

namespace {

int put(MouseNodes& nodes, const std::string& name, std::string_view text) {
    std::uint64_t handle = 0;
    const int opened = nodes.open(name, handle);
    return opened != 0 ? opened : nodes.write(name, handle, text);
}

std::string get(MouseNodes& nodes, const std::string& name) {
    std::uint64_t handle = 0;
    std::string text;
    const int error = nodes.open(name, handle);
    return error != 0 || nodes.read(name, handle, text) != 0 ? "error" : text;
}

}  // namespace

TEST_CASE("a fake motor takes a new rate when the running period is over", "[hw][fakes]") {
    PwmChannel motor;
    motor.write(5, 10.0);
    CHECK(motor.rate(10.0) == 5);
    motor.write(100, 10.3);  // the second period ends at 10.4
    CHECK(motor.rate(10.39) == 5);
    CHECK(motor.rate(10.41) == 100);
    CHECK(motor.pulses(11.4) == 102);
    motor.write(-100, 11.401);
    CHECK(motor.pulses(12.41) == 203);
    CHECK(motor.balance(12.41) == 3);
    motor.write(0, 12.411);
    CHECK(motor.still_since(12.5) == Approx(12.42));
}

TEST_CASE("a fake motor's node is as strict as the kernel", "[hw][fakes]") {
    MouseNodes nodes;
    for (const char* wrong : {"", " 400", "400.0", "x", "4 0"}) CHECK(put(nodes, "rtmotor_raw_l0", wrong) == -EINVAL);
    CHECK(put(nodes, "rtmotor_raw_l0", "400\n") == 4);
    CHECK(nodes.motion().left == 400);
    CHECK(put(nodes, "rtmotor_raw_r0", "-4") == 2);
    CHECK(nodes.motion().right == 0);
    CHECK(put(nodes, "rtmotor_raw_r0", "20000") == 5);
    CHECK(nodes.motion().right == 10000);
}

TEST_CASE("fake switches of power and light read one byte of each write", "[hw][fakes]") {
    MouseNodes nodes;
    CHECK(nodes.motion().power);  // the driver's motors are enabled when it is loaded
    CHECK(put(nodes, "rtmotoren0", "0\n") == 1);
    CHECK_FALSE(nodes.motion().power);
    CHECK(put(nodes, "rtled2", "1") == 1);
    CHECK(nodes.motion().leds == std::vector<bool>{false, false, true, false});
    CHECK(put(nodes, "rtled2", "x") == -EINVAL);
}

TEST_CASE("a fake buzzer is silenced by any write to a motor", "[hw][fakes]") {
    MouseNodes nodes;
    CHECK(put(nodes, "rtbuzzer0", "440") == 3);
    CHECK(nodes.motion().tone == 440);
    CHECK(put(nodes, "rtmotor_raw_l0", "0") == 1);
    CHECK(nodes.motion().tone == 0);
    put(nodes, "rtbuzzer0", "-5");
    CHECK(nodes.motion().tone == 1);
}

TEST_CASE("fake counters wrap, and the last program that opens one decides whether it is signed", "[hw][fakes]") {
    MouseNodes nodes;
    nodes.set_counters(65535);
    CHECK(get(nodes, "rtcounter_l0") == "65535\n");
    nodes.set_counters(0);
    CHECK(get(nodes, "rtcounter_l0") == "0\n");
    nodes.set_counters(40000);
    std::uint64_t handle = 0;
    REQUIRE(nodes.open("rtcounter_l1", handle) == 0);
    std::string text;
    REQUIRE(nodes.read("rtcounter_l0", handle, text) == 0);
    CHECK(text == "0\n");
    CHECK(get(nodes, "rtcounter_l0") == "40000\n");
}

TEST_CASE("a fault of a fake node is an error for its user", "[hw][fakes]") {
    MouseNodes nodes;
    std::uint64_t handle = 0;
    std::string text;
    REQUIRE(nodes.open("rtswitch0", handle) == 0);
    CHECK_FALSE(nodes.set_fault("rtswitch0", "tired"));
    for (const auto& [fault, error] : {std::pair{"eio", -EIO}, {"enodev", -ENODEV}, {"missing", -ENODEV}}) {
        REQUIRE(nodes.set_fault("rtswitch0", fault));
        CHECK(nodes.read("rtswitch0", handle, text) == error);
    }
    CHECK(nodes.look("rtswitch0") == -ENOENT);
    REQUIRE(nodes.set_fault("rtswitch0", "none"));
    CHECK(nodes.read("rtswitch0", handle, text) == 0);
    CHECK(text == "1\n");
    nodes.reload();
    CHECK(nodes.read("rtswitch0", handle, text) == -ENODEV);
    CHECK(nodes.motion().power);
}
