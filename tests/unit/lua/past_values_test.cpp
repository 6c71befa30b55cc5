// Values of the past: those that are remembered, and those that are computed again.
#include <catch2/catch.hpp>

#include <chrono>
#include <string>
#include <vector>

#include "engine/live/past_values.hpp"
#include "engine/trace/recent_curves.hpp"
#include "tests/unit/lua/past_rig.hpp"

using namespace nezumi;

TEST_CASE("plots of a past show the values before it", "[lua][past]") {
    PastRig it;
    it.live->trace().remember_ports();
    it.tick(300);
    const auto before = it.live->trace().remember("keeper.out");
    REQUIRE(before);
    REQUIRE(it.seek(200) == "");
    const auto after = it.live->trace().remember("keeper.out");
    REQUIRE(after);
    CHECK(*before == *after);
    REQUIRE((*after)->size() > 100);
    CHECK((*after)->seconds((*after)->size() - 1) <= 2.0);
    CHECK((*after)->seconds((*after)->size() - 1) > 1.9);
}

TEST_CASE("values that have fallen out of memory are computed again, equal to the bit", "[lua][past]") {
    PastRig short_memory, whole;
    const std::vector<std::string> names{"mouse.ir_sensor_out", "keeper.in",    "keeper.out", "keeper.config",
                                         "mouse.truth",         "keeper.state", "second.out"};
    whole.live->trace().keep(100'000);
    short_memory.live->trace().keep(50);
    for (PastRig* it : {&short_memory, &whole}) {
        it->live->trace().remember_ports();
        for (int i = 0; i < 600; ++i) {
            if (i == 120) it->set_speed(0.2);
            if (i == 200) it->add_second();
            if (i == 250) it->act(Teleport{"mouse", {{-0.5, 0.2}, 1.0}});
            if (i == 1 && it == &whole) {
                for (const std::string& name : names) static_cast<void>(it->live->trace().remember(name));
            }
            if (i == 201) static_cast<void>(it->live->trace().remember("second.out"));
            it->tick();
        }
    }
    const std::uint64_t hash = short_memory.live->trace_hash();
    CHECK_FALSE(short_memory.live->trace().has_since("keeper.out", 1));
    CHECK(whole.live->trace().has_since("keeper.out", 1));
    auto past = PastValues::begin(*short_memory.live, names, 1, 6);
    REQUIRE(past);
    REQUIRE((*past)->run().go_on(PastRun::Clock::time_point::max()));
    for (const std::string& name : names) {
        INFO(name);
        const auto again = recent_curves((*past)->trace(), name, 5, 6),
                   kept = recent_curves(whole.live->trace(), name, 5, 6);
        REQUIRE((again && kept));
        REQUIRE_FALSE(kept->curves.empty());
        REQUIRE(again->curves.size() == kept->curves.size());
        for (std::size_t curve = 0; curve < kept->curves.size(); ++curve) {
            CHECK(again->curves[curve].name == kept->curves[curve].name);
            CHECK(again->curves[curve].points == kept->curves[curve].points);
        }
    }
    CHECK(short_memory.live->trace_hash() == hash);
}

TEST_CASE("values that are computed again go on to later times, not beyond what was known", "[lua][past]") {
    PastRig it;
    it.tick(300);
    auto past = PastValues::begin(*it.live, {"keeper.out"}, 0, 1);
    REQUIRE(past);
    const auto size_at = [&](double to) {
        REQUIRE((*past)->extend(*it.live, {"keeper.out"}, 0, to));
        REQUIRE((*past)->run().go_on(PastRun::Clock::time_point::max()));
        return (*past)->trace().remembered("keeper.out")->size();
    };
    CHECK(size_at(1) == 100);
    CHECK(size_at(2.5) == 250);
    CHECK(size_at(2) == 250);  // it has been there
    CHECK_FALSE((*past)->extend(*it.live, {"keeper.in"}, 0, 1));
    it.tick(10);
    CHECK_FALSE((*past)->extend(*it.live, {"keeper.out"}, 0, 3.05));
    REQUIRE(it.seek(100) == "");
    CHECK_FALSE((*past)->extend(*it.live, {"keeper.out"}, 0, 1));  // of another present
}

TEST_CASE("a past run beside a moving system rarely begins a tick that would end too late", "[lua][past]") {
    PastRig it;
    it.tick(5000);
    auto past = it.live->begin_seek({.tick = 4900});
    REQUIRE(past);
    const auto now = PastRun::Clock::now();
    REQUIRE((*past)->go_on(now + std::chrono::milliseconds(1)));
    const auto at = [&] { return (*past)->system().when().tick; };
    CHECK((*past)->go_on_beside(PastRun::Clock::now()) == false);  // the first since long
    const std::int64_t reached = at();
    CHECK((*past)->go_on_beside(PastRun::Clock::now()) == false);
    CHECK(at() == reached);
    REQUIRE((*past)->go_on_beside(PastRun::Clock::now() + std::chrono::hours(1)) == true);
    CHECK(at() == 4900);
}

TEST_CASE("a trace knows since when it has each value", "[lua][past]") {
    PastRig it;
    it.live->trace().remember_ports();
    it.live->trace().keep(100);
    const Trace& trace = it.live->trace();
    it.tick(50);
    CHECK(trace.has_since("keeper.out", 0));
    CHECK_FALSE(trace.has_since("mouse.truth", 0));
    REQUIRE(it.live->trace().remember("mouse.truth"));
    CHECK_FALSE(trace.has_since("mouse.truth", 0));
    it.add_second();
    it.tick(70);
    CHECK(trace.has_since("mouse.truth", 0.5));
    CHECK(trace.has_since("second.out", 0));  // it was not there before
    CHECK_FALSE(trace.has_since("keeper.out", 0));
    CHECK(trace.has_since("keeper.out", 0.3));
    it.act(Restart{});
    CHECK(trace.has_since("keeper.out", 0));
}
