// Work in another thread: when its result is available, and by which clock.
#include "engine/components/delayed_task.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

using namespace nezumi;

namespace {

Time at_second(double seconds) { return {std::llround(seconds * 100), seconds}; }

void sleep_ms(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

}  // namespace

TEST_CASE("in simulated time a result is there at t + latency, not before, however quick or slow the work is",
          "[engine][latency]") {
    for (const int slow : {0, 30}) {
        DelayedTask<int> work;
        work.start(at_second(1), 0.05, [slow] {
            sleep_ms(slow);
            return 42;
        });
        sleep_ms(30 - slow);
        for (int tick = 0; tick < 5; ++tick) CHECK_FALSE(work.take(at_second(1 + tick / 100.0), true));
        CHECK(work.busy());
        CHECK(work.take(at_second(1 + 5 / 100.0), true).value() == 42);  // waits for it
        CHECK_FALSE(work.take(at_second(2), true));                      // once
        CHECK_FALSE(work.busy());
    }
}

TEST_CASE("without latency a result is there in the tick in which it was asked for", "[engine][latency]") {
    DelayedTask<int> work;
    work.start(at_second(3), 0, [] { return 8; });
    CHECK(work.take(at_second(3), true).value() == 8);
}

TEST_CASE("in real time a result is available when it is ready, without waiting", "[engine][latency]") {
    std::atomic<bool> go = false;
    DelayedTask<int> work;
    work.start(at_second(0), 10, [&] {
        while (!go) sleep_ms(1);
        return 2;
    });
    CHECK_FALSE(work.take(at_second(100), false));
    go = true;
    std::optional<Expected<int>> result;
    for (int i = 0; i < 5000 && !result; ++i) {
        sleep_ms(1);
        result = work.take(at_second(0), false);
    }
    CHECK(result.value() == 2);
}

TEST_CASE("the result of a finished task that is not taken is dropped", "[engine][latency]") {
    std::atomic<bool> done = false;
    DelayedTask<int> work;
    work.start(at_second(0), 0.01, [&] {
        sleep_ms(10);
        done = true;
        return 1;
    });
    work.finish();
    CHECK(done);
    CHECK_FALSE(work.take(at_second(1), true));
}

TEST_CASE("an exception of a task is an error of its result, or dropped with it", "[engine][latency]") {
    for (const bool wait : {true, false}) {
        DelayedTask<int> work;
        work.start(at_second(0), 0, []() -> int { throw std::runtime_error("no memory for the picture"); });
        std::optional<Expected<int>> result;
        for (int i = 0; i < 5000 && !result; ++i) {
            result = work.take(at_second(0), wait);
            if (!result) sleep_ms(1);
        }
        REQUIRE(result);
        REQUIRE_FALSE(*result);
        CHECK(result->error().message == "no memory for the picture");
        work.start(at_second(0), 0, []() -> int { throw 5; });  // not even an exception of the library
        work.finish();
        CHECK_FALSE(work.busy());
    }
}
