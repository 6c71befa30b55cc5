// Rates: when a component is due, which ticks fit the physics, and the wall clock.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/base/schedule.hpp"
#include "engine/system/pacer.hpp"
#include "engine/system/system_spec.hpp"

using namespace nezumi;

namespace {

std::string refusal(double rate, double step) {
    const auto steps = steps_per_tick(rate, step);
    return steps ? "" : steps.error().message;
}

// Ticks of a pacer that begin as soon as they are due, on a clock that moves only by what a test does.
struct Ticks {
    Ticks(double rate, double speed) : pacer(rate, speed, now) {}
    // Returns how long it waited [s].
    double next() {
        const Pacer::Clock::time_point before = now;
        now = std::max(now, pacer.due());
        pacer.begin_tick(now);
        return std::chrono::duration<double>(now - before).count();
    }
    void pass(double seconds) {
        now += std::chrono::duration_cast<Pacer::Clock::duration>(std::chrono::duration<double>(seconds));
    }
    double seconds() const { return std::chrono::duration<double>(now - begin).count(); }

    Pacer::Clock::time_point begin = Pacer::Clock::time_point(std::chrono::hours(1)), now = begin;
    Pacer pacer;
};

}  // namespace

TEST_CASE("a component is due when floor(k * rate / tick rate) grows: exact on average", "[engine][schedule]") {
    for (const auto& [rate, tick_rate] :
         {std::pair{30.0, 100.0}, {33.0, 100.0}, {99.0, 100.0}, {0.5, 100.0}, {7.5, 200.0}, {60.0, 1000.0}}) {
        std::int64_t executed = 0;
        for (std::int64_t k = 0; k < 20000; ++k) {
            if (is_due(k, rate, tick_rate)) ++executed;
            const auto expected =
                static_cast<std::int64_t>(std::floor(static_cast<double>(k) * rate / tick_rate + 1e-9));
            REQUIRE(executed == expected + 1);
        }
    }
    // After a year as in the first second.
    const std::int64_t year = 365LL * 24 * 3600 * 100;
    int executed = 0;
    for (std::int64_t k = year; k < year + 100; ++k) executed += is_due(k, 30, 100) ? 1 : 0;
    CHECK(executed == 30);
    // Where tick times rate has more than 64 bits.
    executed = 0;
    for (std::int64_t k = 9'000'000'000'001; k < 9'000'000'000'001 + 100; ++k) executed += is_due(k, 7e6, 1e7) ? 1 : 0;
    CHECK(executed == 70);
}

TEST_CASE("work that was due in skipped ticks is due once in the next tick", "[engine][schedule]") {
    CHECK_FALSE(is_due(149, 2, 100));
    CHECK(is_due(150, 2, 100));
    CHECK_FALSE(is_due(151, 2, 100));
    CHECK(is_due(151, 2, 100, 1));
    CHECK_FALSE(is_due(199, 2, 100, 48));
    CHECK(is_due(199, 2, 100, 49));
    CHECK(is_due(7, 0.001, 100, 7));  // the first tick is among them
    CHECK_FALSE(is_due(8, 0.001, 100, 7));
    CHECK(is_due(std::int64_t{1} << 50, 1e5, 1e6, std::int64_t{1} << 49));
}

TEST_CASE("without a rate, or at the tick's, a component is due in every tick", "[engine][schedule]") {
    for (std::int64_t k = 0; k < 100; ++k) {
        CHECK(is_due(k, 0, 100));
        CHECK(is_due(k, 100, 100));
    }
}

TEST_CASE("a tick is a whole number of physics steps", "[engine][schedule]") {
    CHECK(steps_per_tick(100, 0.005) == 2);
    CHECK(steps_per_tick(200, 0.005) == 1);
    CHECK(steps_per_tick(10, 0.005) == 20);
    CHECK(steps_per_tick(1000, 0.001) == 1);
    CHECK(steps_per_tick(0.1, 0.005) == 2000);
}

TEST_CASE("a tick that is not a whole number of steps is refused, and the error suggests the nearest rates that fit",
          "[engine][schedule]") {
    CHECK(refusal(60, 0.005) ==
          "rate: a tick of 60 Hz is not a whole number of physics steps of 0.005 s; the nearest rates are 50 or "
          "66.66666666666667 Hz");
    CHECK(refusal(150, 0.005) ==
          "rate: a tick of 150 Hz is not a whole number of physics steps of 0.005 s; the nearest rates are 100 or 200 "
          "Hz");
    CHECK(refusal(500, 0.005) ==
          "rate: a tick of 500 Hz is not a whole number of physics steps of 0.005 s; the nearest rate is 200 Hz");
    CHECK(
        refusal(1e-9, 0.005) ==
        "rate: a tick of 1e-09 Hz is not a whole number of physics steps of 0.005 s up to 1000000; the nearest rate is "
        "0.0002 Hz");
    for (const double rate : {33.0, 60.0, 99.0, 123.4, 150.0}) {
        for (const double step : {0.005, 0.001, 0.0035}) {
            const std::string told = refusal(rate, step);
            if (told.empty()) continue;
            const std::string rates = told.substr(told.find("nearest rates are "));
            double slower = 0, faster = 0;
            REQUIRE(std::sscanf(rates.c_str(), "nearest rates are %lf or %lf Hz", &slower, &faster) == 2);
            CHECK(slower < rate);
            CHECK(faster > rate);
            CHECK(refusal(slower, step).empty());
            CHECK(refusal(faster, step).empty());
        }
    }
}

TEST_CASE("rates and steps are positive numbers", "[engine][schedule]") {
    CHECK(refusal(0, 0.005) == "rate: 0 Hz is not a positive number");
    CHECK(refusal(-5, 0.005) == "rate: -5 Hz is not a positive number");
    CHECK(refusal(std::nan(""), 0.005) == "rate: nan Hz is not a positive number");
    CHECK(refusal(std::numeric_limits<double>::infinity(), 0.005) == "rate: inf Hz is not a positive number");
    CHECK(refusal(5e-7, 4) == "rate: expected from 1e-06 to 1000000 Hz, got 5e-07");
    CHECK(refusal(1e300, 1e-300) == "rate: expected from 1e-06 to 1000000 Hz, got 1e+300");
    CHECK(refusal(100, 0) == "physics: a step of 0 s is not a positive number");
    CHECK(refusal(100, std::nan("")) == "physics: a step of nan s is not a positive number");
}

TEST_CASE("a rate of 1000 Hz is kept for any duration of the ticks", "[engine][pacer]") {
    Ticks ticks(1000, 1);
    for (int i = 0; i <= 100'000; ++i) {
        ticks.next();
        ticks.pass(i % 100 == 50 ? 0.002 : 0.0003);
    }
    CHECK(ticks.seconds() == Approx(100.0003).epsilon(1e-9));  // the first one began at 0
    CHECK(ticks.pacer.lateness().late() == 2000);              // the one after each long tick, and one more
    CHECK(ticks.pacer.lateness().worst() == Approx(0.001).epsilon(1e-6));
    CHECK(ticks.pacer.lateness().skipped() == 0);
}

TEST_CASE("a rate that is not a whole number of nanoseconds does not drift", "[engine][pacer]") {
    Ticks ticks(300, 0.7);
    for (int i = 0; i <= 210'000; ++i) ticks.next();
    CHECK(ticks.seconds() == Approx(1000).epsilon(1e-9));
}

TEST_CASE("a pacer sleeps until the tick is due, never less", "[engine][pacer]") {
    Pacer pacer(100, 10);
    for (int i = 0; i < 50; ++i) {
        const Pacer::Clock::time_point due = pacer.due();
        pacer.wait();
        CHECK(Pacer::Clock::now() >= due);
        CHECK(pacer.due() > due);
    }
}

TEST_CASE("a stall of up to 5 periods is caught up, a longer one is skipped", "[engine][pacer]") {
    Ticks ticks(100, 1);
    for (int i = 0; i < 3; ++i) ticks.next();
    ticks.pass(0.045);  // 4 ticks are missed: they follow at once
    for (int i = 0; i < 4; ++i) CHECK(ticks.next() == 0);
    CHECK(ticks.next() == Approx(0.005));
    CHECK(ticks.pacer.lateness().skipped() == 0);
    CHECK(ticks.pacer.lateness().late() == 4);

    ticks.pass(0.105);
    CHECK(ticks.next() == 0);
    CHECK(ticks.pacer.lateness().skipped() == 9);
    CHECK(ticks.pacer.lateness().worst() == Approx(0.095));
    for (int i = 0; i < 5; ++i) CHECK(ticks.next() == Approx(0.01));  // no burst
}

TEST_CASE("a paused pacer owes nothing", "[engine][pacer]") {
    Ticks ticks(100, 1);
    ticks.next();
    ticks.pass(0.1);
    ticks.pacer.restart(ticks.now);
    CHECK(ticks.next() == 0);
    CHECK(ticks.next() == Approx(0.01));
    CHECK(ticks.pacer.lateness().skipped() == 0);
    CHECK(ticks.pacer.lateness().late() == 0);
}
