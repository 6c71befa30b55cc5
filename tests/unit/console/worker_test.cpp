// A session's thread, and what it has done by the thread that ticks.
#include "bindings/console/worker.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>
#include <vector>

using namespace nezumi;
using namespace std::chrono_literals;

namespace {

void wait_for_the_job(const Worker& worker) {
    const auto end = Worker::Clock::now() + 30s;
    while (!worker.is_idle() && Worker::Clock::now() < end) std::this_thread::sleep_for(1ms);
    REQUIRE(worker.is_idle());
}

void end(Worker& worker) {
    worker.close({});
    REQUIRE(worker.join(Worker::Clock::now() + 30s));
}

}  // namespace

TEST_CASE("waiting for a bell takes the given time unless it rings", "[console][wallclock]") {
    const Bell bell;
    for (const auto patience : {20ms, 1000ms, 1300ms}) {
        CAPTURE(patience.count());
        const auto until = Worker::Clock::now() + patience;
        CHECK_FALSE(bell.wait(until));
        CHECK(Worker::Clock::now() >= until - 1ms);
        CHECK(Worker::Clock::now() < until + 5s);
    }
    bell.ring();
    CHECK(bell.wait(Worker::Clock::now() + 60s));
    bell.clear();
    CHECK_FALSE(bell.wait(Worker::Clock::now()));
}

TEST_CASE("the posts of a job are all done, in order", "[console][worker]") {
    const Bell bell;
    Worker worker(bell);
    std::vector<int> done;
    worker.start([&] {
        for (int i = 1; i <= 3; ++i) worker.post(1, [&done, i] { done.push_back(i); });
    });
    wait_for_the_job(worker);
    CHECK(done.empty());
    worker.serve_posts();
    CHECK(done == std::vector{1, 2, 3});
    end(worker);
}

TEST_CASE("posts of a stopped job are not done", "[console][worker]") {
    const Bell bell;
    Worker worker(bell);
    bool done = false;
    worker.start([&] { worker.post(1, [&done] { done = true; }); });
    wait_for_the_job(worker);
    worker.revoke();
    worker.serve_posts();
    CHECK_FALSE(done);
    end(worker);
}
