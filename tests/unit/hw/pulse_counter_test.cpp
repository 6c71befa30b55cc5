// Counted pulses and ignored readings.
#include "hw/raspimouse/pulse_counter.hpp"

#include <catch2/catch.hpp>

using namespace nezumi::hw;

namespace {

using Verdict = PulseCounter::Verdict;

// A motor that turns at a rate, read every 10 ms, and its counter's value.
struct Wheel {
    // Turns for 10 ms.
    void turn(int rate) {
        motor.set_rate(rate, now);
        now += 0.01;
        made += std::abs(rate) * 0.01;
        true_pulses += rate * 0.01;
    }
    std::uint16_t shows() const { return static_cast<std::uint16_t>(static_cast<std::int64_t>(made) + zero); }
    Verdict read() { return read(shows()); }
    Verdict read(std::uint16_t reading) { return counter.take(reading, motor.until(now)); }
    void drive(int rate, int times) {
        for (int i = 0; i < times; ++i) {
            turn(rate);
            REQUIRE(read() == Verdict::taken);
        }
    }

    CommandedPulses motor;
    PulseCounter counter;
    double now = 100;
    double made = 0;
    double true_pulses = 0;
    std::int64_t zero = 0;  // what the counter showed at the beginning
};

}  // namespace

TEST_CASE("pulses have the sign of the command", "[hw][mouse][odometry]") {
    Wheel wheel;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.drive(500, 100);
    CHECK(wheel.counter.pulses() == 500);
    wheel.drive(-500, 60);
    CHECK(wheel.counter.pulses() == 200);
    wheel.drive(0, 10);
    CHECK(wheel.counter.pulses() == 200);
}

TEST_CASE("when the direction changes between two readings, their pulses are divided", "[hw][mouse][odometry]") {
    Wheel wheel;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.turn(3000);
    wheel.turn(-1000);
    REQUIRE(wheel.read() == Verdict::taken);  // 30 forward, 10 backward
    CHECK(wheel.counter.pulses() == 20);
}

TEST_CASE("counting continues when a counter wraps", "[hw][mouse][odometry]") {
    Wheel wheel;
    wheel.zero = 65530;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.drive(500, 100);
    CHECK(wheel.counter.pulses() == 500);
}

TEST_CASE("a 0 from a failed reading is ignored", "[hw][mouse][odometry]") {
    Wheel wheel;
    wheel.zero = 3000;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.drive(500, 10);
    for (int i = 0; i < 20; ++i) {
        wheel.turn(500);
        CHECK(wheel.read(0) == Verdict::zero);
    }
    wheel.turn(500);
    CHECK(wheel.read() == Verdict::taken);
    CHECK(wheel.counter.pulses() == 155);  // none is lost
}

TEST_CASE("a counter that stays at 0 while its motor turns counts as failed", "[hw][mouse][odometry]") {
    Wheel wheel;
    REQUIRE(wheel.read(0) == Verdict::taken);
    for (int i = 0; i < 12; ++i) {
        wheel.turn(500);
        CHECK(wheel.read(0) == Verdict::taken);
    }
    wheel.turn(500);
    CHECK(wheel.read(0) == Verdict::zero);
    CHECK(wheel.read() == Verdict::taken);
    CHECK(wheel.counter.pulses() == 65);
}

TEST_CASE("a torn reading is ignored, and the next one includes its pulses", "[hw][mouse][odometry]") {
    Wheel wheel;
    wheel.zero = 1000;
    REQUIRE(wheel.read() == Verdict::taken);
    for (const int tear : {256, -256}) {
        wheel.drive(500, 10);
        wheel.turn(500);
        CHECK(wheel.read(static_cast<std::uint16_t>(wheel.shows() + tear)) == Verdict::doubted);
        wheel.drive(500, 1);
    }
    CHECK(wheel.counter.pulses() == 120);
}

TEST_CASE("a counter with a new starting value is accepted at the third reading", "[hw][mouse][odometry]") {
    Wheel wheel;
    wheel.zero = 20000;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.drive(500, 100);
    wheel.zero = -400;  // its module was loaded again
    wheel.turn(500);
    CHECK(wheel.read() == Verdict::doubted);
    wheel.turn(500);
    CHECK(wheel.read() == Verdict::doubted);
    wheel.turn(500);
    CHECK(wheel.read() == Verdict::jumped);
    CHECK(wheel.counter.pulses() == 515);  // those of the jump are those commanded
    wheel.zero = 40000;                    // opened again: it may start at any value
    wheel.drive(-500, 10);
    CHECK(wheel.counter.pulses() == 465);
}

TEST_CASE("a counter that was away may start at any value", "[hw][mouse][odometry]") {
    Wheel wheel;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.drive(500, 10);
    wheel.zero = -50;  // reloaded: the value would fit the last one
    for (int i = 0; i < 10; ++i) wheel.turn(500);
    wheel.counter.begin_anew();
    CHECK(wheel.read() == Verdict::taken);
    CHECK(wheel.counter.pulses() == 100);
    wheel.drive(500, 10);
    CHECK(wheel.counter.pulses() == 150);
}

TEST_CASE("a counter that has become signed is noticed when it counts downwards", "[hw][mouse][odometry]") {
    Wheel wheel;
    wheel.zero = 30000;
    REQUIRE(wheel.read() == Verdict::taken);
    wheel.drive(-500, 100);
    std::uint16_t down = 100;
    for (const Verdict verdict : {Verdict::doubted, Verdict::doubted, Verdict::jumped}) {
        wheel.turn(-500);
        CHECK(wheel.read(down -= 5) == verdict);
    }
    CHECK(wheel.counter.pulses() == -515);
}
