// The order of writes to the mouse's motors, and the rates that are written.
#include "hw/raspimouse/motor_plan.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "hw/raspimouse/step_rate.hpp"

using namespace nezumi::hw;

namespace {

// "power 1, left 100": the writes from one state to another.
std::string writes(const MotorState& is, const MotorState& wanted) {
    std::string text;
    for (const MotorWrite& write : plan(is, wanted)) {
        constexpr const char* names[] = {"power", "left", "right", "buzzer"};
        text += (text.empty() ? "" : ", ") + std::string(names[static_cast<int>(write.node)]) + " " +
                std::to_string(write.value);
    }
    return text;
}

constexpr MotorState off{};
constexpr MotorState standing{.power = true};
constexpr MotorState driving{.power = true, .left = 400, .right = 380};

}  // namespace

TEST_CASE("power is switched on before motion and off after it", "[hw][mouse][safety]") {
    CHECK(writes(off, driving) == "power 1, left 400, right 380");
    CHECK(writes(driving, off) == "left 0, right 0, power 0");
    CHECK(writes(driving, standing) == "left 0, right 0");
    CHECK(writes(driving, {.power = false, .left = 400, .right = 380}) == "left 0, right 0, power 0");
}

TEST_CASE("only changes are written, because each write to a motor silences the buzzer", "[hw][mouse]") {
    CHECK(writes(driving, driving).empty());
    CHECK(writes(driving, {.power = true, .left = 400, .right = 390}) == "right 390");
    CHECK(writes({.tone = 440}, {.tone = 440}).empty());
}

TEST_CASE("a tone ends before the wheels turn, and sounds at standstill only", "[hw][mouse]") {
    CHECK(writes({.power = true, .tone = 440}, {.power = true, .left = 50, .right = 50, .tone = 440}) ==
          "buzzer 0, left 50, right 50");
    CHECK(writes(driving, {.power = true, .left = 400, .right = 380, .tone = 440}).empty());
    CHECK(writes(driving, {.power = true, .tone = 440}) == "left 0, right 0, buzzer 440");
    CHECK(writes({.power = true, .tone = 440}, {.power = true, .tone = 880}) == "buzzer 880");
    CHECK(writes({.power = true, .tone = 440}, {.power = false, .tone = 440}) == "power 0");
}

TEST_CASE("a ramp skips the lowest rates, but a steady request for one is fulfilled", "[hw][mouse]") {
    StepRate wheel(0.001, 10);  // 1 mm a pulse
    CHECK(wheel.next(0.007, 0, 0.01) == 0);
    CHECK(wheel.next(0.014, 0, 0.01) == 0);
    CHECK(wheel.next(0.021, 0, 0.01) == 21);
    CHECK(wheel.next(0.012, 21, 0.01) == 0);
    CHECK(wheel.next(0.012, 0, 0.01) == 12);
    CHECK(wheel.next(-0.012, 12, 0.01) == 0);
    CHECK(wheel.next(0, 0, 0.01) == 0);
}

TEST_CASE("after an unexpected stop a motor accelerates as from standstill", "[hw][mouse][safety]") {
    StepRate wheel(0.001, 1);  // 1000 pulses/s^2
    CHECK(wheel.next(0.5, 500, 0.01) == 500);
    CHECK(wheel.next(0.5, 0, 0.01) == StepRate::at_once);
    CHECK(wheel.next(0.5, 50, 0.01) == 65);
    CHECK(wheel.next(0.5, 65, 5.0) == 215);  // after a gap the speed must not jump
    CHECK(wheel.next(-0.5, 215, 0.01) == -StepRate::at_once);
    CHECK(wheel.next(0.1, 500, 0.01) == 100);  // braking is limited by the robot, not here
}

TEST_CASE("a rate stays within what the driver takes", "[hw][mouse]") {
    StepRate wheel(0.001, 1e9);
    CHECK(wheel.next(100, 0, 0.1) == StepRate::highest);
    CHECK(wheel.next(-100, 0, 0.1) == -StepRate::highest);
    CHECK(wheel.next(std::numeric_limits<double>::quiet_NaN(), 100, 0.1) == 0);
}
