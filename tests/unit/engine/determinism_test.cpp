// The same run gives the same trace: with any number of threads, and beside other systems.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "engine/base/worker_pool.hpp"
#include "engine/trace/trace_hash.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

// Components, the first `ring` of them wired as a ring and the others in rings of three: each mixes what it reads into
// what it says, some fail on the way.
struct Rings {
    explicit Rings(int threads, int size = 150, int ring = 150)
        : system({.threads = threads}, [this](const LogLine& line) { log.push_back(line.component + line.text); }) {
        for (int i = 0; i < size; ++i) {
            auto made = std::make_unique<TryComponent>("n" + std::to_string(i));
            made->executed = [i](TryComponent& self) -> Expected<void> {
                const auto heard = static_cast<std::uint32_t>(self.in.read());
                self.out.write(static_cast<std::int32_t>(heard * 31 + static_cast<std::uint32_t>(i)));
                if (i % 50 == 7 && self.executions() == 20) return failure("tired");
                return {};
            };
            if (i % 3 == 1) made->rate = 33;
            auto* it = *system.add(std::move(made));
            static_cast<void>(it->activate(system.now()));
        }
        for (int i = 0; i < size; ++i) {
            const int first = i < ring ? 0 : i - (i - ring) % 3, last = i < ring ? std::min(ring, size) - 1 : first + 2;
            const auto from = "n" + std::to_string(i) + ".out";
            REQUIRE(system.connect(from, "n" + std::to_string(i < last ? i + 1 : first) + ".in"));
        }
        system.observe(trace);
    }
    void ticks(int count) {
        for (int i = 0; i < count; ++i) system.tick();
    }

    std::vector<std::string> log;
    System system;
    TraceHash trace;
};

}  // namespace

TEST_CASE("one, two and four threads give the same trace and the same log", "[engine][determinism]") {
    // Few components, a ring so large that it is shared out, small ones alone, and both.
    const auto [size, ring] =
        GENERATE(std::pair{150, 150}, std::pair{300, 300}, std::pair{300, 0}, std::pair{450, 300});
    Rings one(1, size, ring), two(2, size, ring), four(4, size, ring);
    for (Rings* rings : {&one, &two, &four}) rings->ticks(100);
    CHECK(one.trace.value() == two.trace.value());
    CHECK(one.trace.value() == four.trace.value());
    CHECK(one.log.size() == static_cast<std::size_t>(size / 50));
    CHECK(one.log == two.log);
    CHECK(one.log == four.log);
}

TEST_CASE("a trace hash counts later components by their names, also when one takes the place of another",
          "[engine][determinism]") {
    const auto add_talker = [](System& system, const std::string& name) {
        auto made = std::make_unique<TryComponent>(name);
        made->executed = [](TryComponent& self) -> Expected<void> {
            self.out.write(5);
            return {};
        };
        static_cast<void>((*system.add(std::move(made)))->activate(system.now()));
    };
    // The hash of three ticks: with "first" alone, with "second" beside it, with `last` in the place of "second".
    const auto run = [&](const std::string& last, bool anew) {
        System system({}, nullptr);
        TraceHash trace, rest;
        system.observe(trace);
        add_talker(system, "first");
        system.tick();
        add_talker(system, "second");
        system.tick();
        const std::uint64_t before = trace.value();
        REQUIRE(system.remove("second"));
        add_talker(system, last);
        system.observe(rest);
        system.tick();
        return anew ? before + rest.value() : trace.value();
    };
    CHECK(run("third", false) == run("third", true));
    CHECK(run("third", false) != run("second", false));
}

TEST_CASE("the order in which behaviours stand in the file changes neither what they do nor the trace hash",
          "[engine][determinism]") {
    const auto run = [](const std::vector<std::string>& order) {
        System system({}, nullptr);
        TraceHash trace;
        system.observe(trace);
        for (const std::string& name : order) {
            auto made = std::make_unique<TryComponent>(name);
            made->executed = [](TryComponent& self) -> Expected<void> {
                self.out.write(3 * self.in.read() + static_cast<std::int32_t>(self.name().back()));
                if (self.executions() % 3 == 0) self.tone.write(7);
                return {};
            };
            static_cast<void>((*system.add(std::move(made)))->activate(system.now()));
        }
        for (const auto& [from, to] : {std::pair{"a.out", "b.in"}, {"b.out", "c.in"}, {"c.out", "a.in"}})
            REQUIRE(system.connect(from, to));
        for (int i = 0; i < 10; ++i) system.tick();
        return trace.value();
    };
    CHECK(run({"a", "b", "c"}) == run({"c", "a", "b"}));
    CHECK(run({"a", "b", "c"}) == run({"b", "a", "c"}));
}

TEST_CASE("ticks do not depend on the number of threads after connections and components have changed",
          "[engine][determinism]") {
    std::vector<std::uint64_t> traces;
    for (const int threads : {1, 2}) {
        Rings rings(threads, 330, 300);
        rings.ticks(10);
        REQUIRE(rings.system.connect("n3.out", "n320.in"));  // a small ring becomes part of the large one
        rings.ticks(10);
        REQUIRE(rings.system.remove("n3"));
        REQUIRE(rings.system.disconnect("n150.out", "n151.in"));
        rings.ticks(10);
        auto made = std::make_unique<TryComponent>("late");
        made->executed = [](TryComponent& self) -> Expected<void> {
            self.out.write(self.in.read() + 1);
            return {};
        };
        REQUIRE((*rings.system.add(std::move(made)))->activate(rings.system.now()));
        rings.ticks(10);
        REQUIRE(rings.system.connect("n8.out", "late.in"));
        rings.ticks(10);
        CHECK(rings.system.port("late.out").value()->value().get<std::int32_t>() != 1);
        traces.push_back(rings.trace.value());
    }
    CHECK(traces[0] == traces[1]);
}

TEST_CASE("systems in one process know nothing of each other", "[engine][determinism]") {
    Rings alone(1), first(1), second(1, 77);
    alone.ticks(50);
    for (int i = 0; i < 50; ++i) {
        first.ticks(1);
        second.ticks(2);
    }
    CHECK(first.trace.value() == alone.trace.value());
    CHECK(first.log == alone.log);
    CHECK(second.system.now().tick == 100);
}

TEST_CASE("a trace hash tells runs apart by port, by tick and by value", "[engine][determinism]") {
    // The hash of one publication.
    const auto hash = [](const char* component, std::int64_t tick, std::int32_t value) {
        System system({}, nullptr);
        TraceHash trace;
        system.observe(trace);
        auto made = std::make_unique<TryComponent>(component);
        made->executed = [=](TryComponent& self) -> Expected<void> {
            if (self.now().tick == tick) self.out.write(value);
            return {};
        };
        REQUIRE((*system.add(std::move(made)))->activate(system.now()));
        for (int i = 0; i < 5; ++i) system.tick();
        return trace.value();
    };
    CHECK(hash("a", 1, 5) == hash("a", 1, 5));
    CHECK(hash("a", 1, 5) != hash("b", 1, 5));
    CHECK(hash("a", 1, 5) != hash("a", 2, 5));
    CHECK(hash("a", 1, 5) != hash("a", 1, 6));
}

TEST_CASE("a removed observer gets nothing more", "[engine][determinism]") {
    Rings ring(1, 3, 3);
    ring.ticks(3);
    const std::uint64_t before = ring.trace.value();
    ring.system.stop_observing(ring.trace);
    ring.ticks(3);
    CHECK(ring.trace.value() == before);
}

TEST_CASE("a pool's rounds may follow each other at once, or when its threads have gone to sleep",
          "[engine][determinism]") {
    for (const int threads : {2, 5}) {
        WorkerPool pool(threads);
        std::vector<int> done(40, 0);
        for (int round = 0; round < 2000; ++round) {
            if (round % 200 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
            pool.run(done.size(), [&](std::size_t begin, std::size_t end, std::size_t worker) {
                // The last share takes long now and then: then it is the caller that sleeps.
                if (round % 200 == 100 && worker + 1 == pool.size())
                    std::this_thread::sleep_for(std::chrono::milliseconds(5));
                for (std::size_t i = begin; i < end; ++i) ++done[i];
            });
        }
        CHECK(done == std::vector<int>(40, 2000));
    }
}

TEST_CASE("a pool does every number once, with more threads than numbers as well", "[engine][determinism]") {
    for (const int threads : {1, 2, 5}) {
        WorkerPool pool(threads);
        CHECK(pool.size() == static_cast<std::size_t>(threads));
        for (const std::size_t count : {0u, 1u, 3u, 1000u}) {
            std::vector<int> done(count, 0);
            pool.run(count, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t i = begin; i < end; ++i) ++done[i];
            });
            CHECK(done == std::vector<int>(count, 1));
        }
    }
}
