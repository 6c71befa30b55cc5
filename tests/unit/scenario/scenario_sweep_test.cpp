// Sweeps: combinations, draws, names of runs and the way back from them, simpler points.
#include <catch2/catch.hpp>

#include "bindings/scenario/sweep.hpp"

using namespace nezumi;

namespace {

template <class T>
SweepValue value(T held) {
    PlainData data;
    data.values.emplace_back(std::move(held));
    return to_sweep_value(std::move(data));
}

Sweep two_lists() {
    Sweep sweep;
    sweep.keys.push_back({"name", std::vector{value(std::string("fast")), value(std::string("a, b=\"1\""))}});
    sweep.keys.push_back({"speed", std::vector{value(0.1), value(std::int64_t{2}), value(3.0)}});
    return sweep;
}

Sweep one_range(SweepRange range) {
    Sweep sweep;
    sweep.keys.push_back({"x", range});
    sweep.samples = 50;
    return sweep;
}

double number(const SweepPoint& point) { return std::get<double>(point.front().second.data.values.front()); }

}  // namespace

TEST_CASE("a sweep makes every combination, the last key changing fastest", "[lua][scenario][sweep]") {
    std::vector<std::string> names;
    for (const SweepPoint& point : combinations(two_lists())) names.push_back(text_of(point));
    CHECK(names == std::vector<std::string>{"[name=fast, speed=0.1]", "[name=fast, speed=2]", "[name=fast, speed=3.0]",
                                            "[name=\"a, b=\\\"1\\\"\", speed=0.1]",
                                            "[name=\"a, b=\\\"1\\\"\", speed=2]",
                                            "[name=\"a, b=\\\"1\\\"\", speed=3.0]"});
}

TEST_CASE("a scenario without a sweep has one run without values", "[lua][scenario][sweep]") {
    REQUIRE(combinations({}).size() == 1);
    CHECK(text_of(combinations({}).front()).empty());
}

TEST_CASE("the values in a run's name lead back to its point", "[lua][scenario][sweep]") {
    const Sweep sweep = two_lists();
    for (const SweepPoint& point : combinations(sweep)) CHECK(find_point(sweep, text_of(point)) == point);
    CHECK_FALSE(find_point(sweep, "[name=fast, speed=0.2]"));
    CHECK_FALSE(find_point(sweep, "[name=fast]"));
    CHECK_FALSE(find_point(sweep, "name=fast, speed=0.1"));

    const Sweep drawn = one_range({.lo = -1, .hi = 1});
    for (std::size_t i = 0; i < drawn.samples; ++i) {
        const SweepPoint point = draw(drawn, 124, i);
        CHECK(find_point(drawn, text_of(point)) == point);
    }
    CHECK_FALSE(find_point(drawn, "[x=1.5]"));
    CHECK_FALSE(find_point(drawn, "[x=nan]"));
}

TEST_CASE("draws lie within the range and depend on seed and index alone", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = 2, .hi = 3});
    for (std::size_t i = 0; i < 50; ++i) {
        const SweepPoint point = draw(sweep, 7, i);
        CHECK(number(point) >= 2);
        CHECK(number(point) <= 3);
        CHECK(draw(sweep, 7, i) == point);
        CHECK_FALSE(draw(sweep, 8, i) == point);
        CHECK_FALSE(draw(sweep, 7, i + 1) == point);
    }
}

TEST_CASE("a range with a step draws its multiples, as integers when lo and step are", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = 1, .hi = 9, .step = 4, .whole = true});
    bool seen[10]{};
    for (std::size_t i = 0; i < 50; ++i) {
        const auto drawn = std::get<std::int64_t>(draw(sweep, 7, i).front().second.data.values.front());
        REQUIRE((drawn == 1 || drawn == 5 || drawn == 9));
        seen[drawn] = true;
    }
    CHECK((seen[1] && seen[5] && seen[9]));
}

TEST_CASE("simplifying comes to an end, nearer to zero or shorter with every step", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = -10, .hi = 10});
    for (std::size_t i = 0; i < 20; ++i) {
        SweepPoint point = draw(sweep, 3, i);
        const bool positive = number(point) > 0;
        // What fails is everything beyond 0.62 on the same side.
        const auto fails = [&](const SweepPoint& p) { return (positive ? number(p) : -number(p)) > 0.62; };
        if (!fails(point)) continue;
        int steps = 0;
        for (bool changed = true; changed; ++steps) {
            REQUIRE(steps < 100);
            changed = false;
            for (const SweepPoint& candidate : simpler(sweep, point)) {
                if (!fails(candidate)) continue;
                point = candidate;
                changed = true;
                break;
            }
        }
        CHECK(std::abs(number(point)) <= 1.0);
    }
}

TEST_CASE("a listed value is simplified to one that stands before it", "[lua][scenario][sweep]") {
    const Sweep sweep = two_lists();
    const std::vector<SweepPoint> all = combinations(sweep);
    CHECK(simpler(sweep, all.front()).empty());
    CHECK(simpler(sweep, all[1]) == std::vector<SweepPoint>{all[0]});
}
