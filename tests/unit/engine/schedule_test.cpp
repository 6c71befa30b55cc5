// Rates: when a component is due, which ticks fit the physics, and the wall clock.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <thread>

#include "engine/pacer.hpp"
#include "engine/system_spec.hpp"

using namespace nezumi;

namespace {

std::string refusal(double rate, double step) {
    const auto steps = steps_per_tick(rate, step);
    return steps ? "" : steps.error().message;
}

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

TEST_CASE("a tick that is no whole number of steps is told with the nearest rates, which fit", "[engine][schedule]") {
    CHECK(refusal(60, 0.005) ==
          "rate: a tick of 60 Hz is no whole number of physics steps of 0.005 s; the nearest rates are 50 or "
          "66.66666666666667 Hz");
    CHECK(refusal(150, 0.005) ==
          "rate: a tick of 150 Hz is no whole number of physics steps of 0.005 s; the nearest rates are 100 or 200 Hz");
    CHECK(refusal(500, 0.005) ==
          "rate: a tick of 500 Hz is no whole number of physics steps of 0.005 s; the nearest rate is 200 Hz");
    CHECK(refusal(1e-9, 0.005) ==
          "rate: a tick of 1e-09 Hz is no whole number of physics steps of 0.005 s up to 1000000; the nearest rate is "
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
    CHECK(refusal(100, 0) == "physics: a step of 0 s is not a positive number");
    CHECK(refusal(100, std::nan("")) == "physics: a step of nan s is not a positive number");
}

TEST_CASE("1000 Hz asked is 1000 Hz given on average", "[engine][pacer][wallclock]") {
    Pacer pacer(1000, 1);
    const auto begin = Pacer::Clock::now();
    std::uint64_t ticks = 0;
    while (ticks < 3000) {
        pacer.wait();
        ++ticks;
        if (ticks % 100 == 50) std::this_thread::sleep_for(std::chrono::milliseconds(2));  // a tick that takes longer
    }
    const double seconds = std::chrono::duration<double>(Pacer::Clock::now() - begin).count();
    // The first tick begins at 0. What was skipped after a stall of the machine was not given.
    CHECK(static_cast<double>(ticks - 1 + pacer.skipped()) / seconds == Approx(1000).epsilon(0.001));
    CHECK(pacer.late() >= 30);
    CHECK(pacer.worst_lateness() >= pacer.lateness());
}

TEST_CASE("a pacer runs at any speed", "[engine][pacer][wallclock]") {
    Pacer pacer(100, 1);
    pacer.set_speed(10);
    CHECK(pacer.speed() == 10);
    const auto begin = Pacer::Clock::now();
    for (int i = 0; i <= 500; ++i) pacer.wait();
    CHECK(std::chrono::duration<double>(Pacer::Clock::now() - begin).count() == Approx(0.5).epsilon(0.02));
}

TEST_CASE("a stall of up to 5 periods is caught up, a longer one is skipped", "[engine][pacer][wallclock]") {
    using namespace std::chrono_literals;
    Pacer pacer(100, 1);
    for (int i = 0; i < 3; ++i) pacer.wait();
    std::this_thread::sleep_for(35ms);  // 3 ticks are missed: they follow at once
    for (int i = 0; i < 3; ++i) {
        const auto begin = Pacer::Clock::now();
        pacer.wait();
        CHECK(Pacer::Clock::now() - begin < 5ms);
    }
    CHECK(pacer.skipped() == 0);
    CHECK(pacer.late() >= 3);

    pacer.wait();
    std::this_thread::sleep_for(105ms);
    pacer.wait();
    CHECK(pacer.skipped() == Approx(9).margin(1.1));
    CHECK(pacer.worst_lateness() > 0.09);
    const auto begin = Pacer::Clock::now();
    for (int i = 0; i < 5; ++i) pacer.wait();
    CHECK(Pacer::Clock::now() - begin > 45ms);  // no burst
}

TEST_CASE("a paused pacer owes nothing", "[engine][pacer][wallclock]") {
    using namespace std::chrono_literals;
    Pacer pacer(100, 1);
    pacer.wait();
    std::this_thread::sleep_for(100ms);
    pacer.restart();
    CHECK(pacer.until_due() <= 0ms);
    pacer.wait();
    CHECK(pacer.skipped() == 0);
    CHECK(pacer.until_due() > 5ms);
}
