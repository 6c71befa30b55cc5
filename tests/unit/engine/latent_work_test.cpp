// Work beside the tick: when its results are handed back, and by which clock.
#include "engine/latent_work.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>

#include "engine/trace_hash.hpp"

using namespace nezumi;

namespace {

using Work = LatentWork<int, int>;

Time at(double seconds) { return {std::llround(seconds * 100), seconds}; }

Expected<int> doubled(int& job) { return 2 * job; }

// A result when there is one, -1 otherwise.
int taken(Work& work, double seconds) {
    auto result = work.take(at(seconds));
    return result ? result->value() : -1;
}

void sleep_ms(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

}  // namespace

TEST_CASE("in simulated time a result is there at t + latency, not before, however quick or slow the work is",
          "[engine][latency]") {
    for (const int slow : {0, 30}) {
        Work work(
            [slow](int& job) -> Expected<int> {
                sleep_ms(slow);
                return 2 * job;
            },
            0.05, Work::Clock::simulated);
        CHECK(taken(work, 0.99) == -1);
        REQUIRE(work.give(21, at(1)));
        sleep_ms(30 - slow);
        for (int tick = 0; tick < 5; ++tick) CHECK(taken(work, 1 + tick / 100.0) == -1);
        CHECK(taken(work, 1 + 5 / 100.0) == 42);  // waits for it
        CHECK(taken(work, 2) == -1);              // once
    }
}

TEST_CASE("without latency a result is handed back in the tick it was asked for", "[engine][latency]") {
    Work work(doubled, 0, Work::Clock::simulated);
    REQUIRE(work.give(4, at(3)));
    CHECK(taken(work, 3) == 8);
}

TEST_CASE("on the wall clock a result is handed back when it is ready", "[engine][latency]") {
    std::atomic<bool> go = false;
    Work work(
        [&](int& job) -> Expected<int> {
            while (!go) sleep_ms(1);
            return 2 * job;
        },
        10, Work::Clock::wall);
    REQUIRE(work.give(1, at(0)));
    CHECK(taken(work, 100) == -1);  // never waits
    go = true;
    int result = -1;
    for (int i = 0; i < 5000 && result == -1; ++i) {
        sleep_ms(1);
        result = taken(work, 0);
    }
    CHECK(result == 2);
}

TEST_CASE("as many jobs as its depth are under way, in order, and one more is refused and counted",
          "[engine][latency]") {
    Work work(doubled, 0.1, Work::Clock::simulated, 2);
    CHECK(work.give(1, at(0)));
    CHECK(work.give(2, at(0.05)));
    CHECK_FALSE(work.give(3, at(0.06)));
    CHECK(work.refused() == 1);
    CHECK(taken(work, 0.1) == 2);
    CHECK(work.give(4, at(0.1)));
    CHECK(taken(work, 0.14) == -1);
    CHECK(taken(work, 0.3) == 4);
    CHECK(taken(work, 0.3) == 8);
}

TEST_CASE("what goes wrong in the work comes back as an error, and the next job is done", "[engine][latency]") {
    Work work(
        [](int& job) -> Expected<int> {
            if (job == 1) return failure("an empty picture");
            if (job == 2) throw std::runtime_error("out of cameras");
            return job;
        },
        0, Work::Clock::simulated);
    REQUIRE(work.give(1, at(0)));
    CHECK(work.take(at(0))->error().message == "an empty picture");
    REQUIRE(work.give(2, at(0)));
    CHECK(work.take(at(0))->error().message == "out of cameras");
    REQUIRE(work.give(3, at(0)));
    CHECK(taken(work, 0) == 3);
}

TEST_CASE("cancelled jobs hand nothing back, and new ones can be given", "[engine][latency]") {
    Work work(
        [](int& job) -> Expected<int> {
            sleep_ms(5);
            return job;
        },
        0.1, Work::Clock::simulated, 3);
    for (int i = 0; i < 3; ++i) REQUIRE(work.give(i, at(0)));
    work.cancel();
    CHECK(taken(work, 9) == -1);
    REQUIRE(work.give(7, at(9)));
    CHECK(taken(work, 9.1) == 7);
}

TEST_CASE("work that is under way when its component goes is waited for", "[engine][latency]") {
    std::atomic<int> done = 0;
    {
        Work work(
            [&](int& job) -> Expected<int> {
                sleep_ms(20);
                ++done;
                return job;
            },
            1, Work::Clock::simulated);
        REQUIRE(work.give(1, at(0)));
        sleep_ms(5);
    }
    const int after = done;
    sleep_ms(30);
    CHECK(done == after);
}

namespace {

// Sends the count of its executions through slow work.
class Slow : public Component {
public:
    explicit Slow(int jitter) : Component("slow", "Slow"), jitter_(jitter) {}

private:
    Expected<void> on_execute() override {
        static_cast<void>(work_.give(static_cast<int>(executions()), now()));
        while (auto result = work_.take(now())) out_.write(result->value());
        return {};
    }

    OutPort<std::int32_t>& out_ = add_out_port<std::int32_t>("out");
    int jitter_;
    Work work_{[this](int& job) -> Expected<int> {
                   if (jitter_ > 0) sleep_ms(job * 7 % jitter_);
                   return job;
               },
               0.03, Work::Clock::simulated};
};

}  // namespace

TEST_CASE("a run with work beside the tick has the same trace hash however long the work takes",
          "[engine][latency][determinism]") {
    const auto hash = [](int jitter) {
        System system({}, nullptr);
        TraceHash trace;
        system.observe(trace);
        auto* slow = *system.add(std::make_unique<Slow>(jitter));
        REQUIRE(slow->activate(system.now()));
        for (int i = 0; i < 60; ++i) system.tick();
        CHECK(slow->out_ports()[0]->count() == 19);
        return trace.value();
    };
    const std::uint64_t expected = hash(0);
    CHECK(hash(5) == expected);
    CHECK(hash(12) == expected);
}
