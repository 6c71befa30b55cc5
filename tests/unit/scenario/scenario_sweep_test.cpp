// Sweeps: combinations, draws, names of runs and the way back from them, simpler points.
#include <catch2/catch.hpp>
#include <set>

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

// All points of a sweep of lists and ranges with a step.
std::vector<SweepPoint> combinations_of(Sweep sweep) {
    sweep.samples = 100'000;
    return draws(sweep, 1);
}

double number(const SweepPoint& point) { return point.front().second.data.values.front().get<double>(); }

}  // namespace

TEST_CASE("a sweep makes all combinations, and the last key changes fastest", "[lua][scenario][sweep]") {
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

TEST_CASE("the values in a run's name identify its point", "[lua][scenario][sweep]") {
    const Sweep sweep = two_lists();
    for (const SweepPoint& point : combinations(sweep)) CHECK(find_point(sweep, text_of(point)) == point);
    CHECK_FALSE(find_point(sweep, "[name=fast, speed=0.2]"));
    CHECK_FALSE(find_point(sweep, "[name=fast]"));
    CHECK_FALSE(find_point(sweep, "name=fast, speed=0.1"));

    const Sweep drawn = one_range({.lo = -1, .hi = 1});
    for (std::size_t i = 0; i < drawn.samples; ++i) {
        const SweepPoint point = draw_point(drawn, 124, i);
        CHECK(find_point(drawn, text_of(point)) == point);
    }
    CHECK_FALSE(find_point(drawn, "[x=1.5]"));
    CHECK_FALSE(find_point(drawn, "[x=nan]"));
}

TEST_CASE("draws are within the range, and depend only on seed and index", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = 2, .hi = 3});
    for (std::size_t i = 0; i < 50; ++i) {
        const SweepPoint point = draw_point(sweep, 7, i);
        CHECK(number(point) >= 2);
        CHECK(number(point) <= 3);
        CHECK(draw_point(sweep, 7, i) == point);
        CHECK_FALSE(draw_point(sweep, 8, i) == point);
        CHECK_FALSE(draw_point(sweep, 7, i + 1) == point);
    }
}

TEST_CASE("a range with a step draws multiples, which are integers if lo and step are", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = 1, .hi = 9, .step = 4, .whole = true});
    bool seen[10]{};
    for (std::size_t i = 0; i < 50; ++i) {
        const auto drawn = draw_point(sweep, 7, i).front().second.data.values.front().get<std::int64_t>();
        REQUIRE((drawn == 1 || drawn == 5 || drawn == 9));
        seen[drawn] = true;
    }
    CHECK((seen[1] && seen[5] && seen[9]));
}

TEST_CASE("countable values are drawn without repetition", "[lua][scenario][sweep]") {
    const auto texts = [](const Sweep& sweep, std::uint64_t seed) {
        std::vector<std::string> all;
        for (const SweepPoint& point : draws(sweep, seed)) all.push_back(text_of(point));
        return all;
    };
    Sweep sweep = one_range({.lo = 0.5, .hi = 2, .step = 0.5});
    CHECK(texts(sweep, 1) == std::vector<std::string>{"[x=0.5]", "[x=1.0]", "[x=1.5]", "[x=2.0]"});
    sweep.keys.insert(sweep.keys.begin(), two_lists().keys.back());
    sweep.keys.front().name = "a";
    sweep.samples = 12;
    CHECK(texts(sweep, 1).size() == 12);
    CHECK(texts(sweep, 1).front() == "[a=0.1, x=0.5]");
    CHECK(texts(sweep, 1).back() == "[a=3.0, x=2.0]");

    sweep.samples = 11;  // one less than there are
    std::set<std::string> left_out;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const std::vector<std::string> drawn = texts(sweep, seed);
        CHECK(drawn.size() == 11);
        const std::set<std::string> once(drawn.begin(), drawn.end());
        CHECK(once.size() == 11);
        CHECK(texts(sweep, seed) == drawn);
        for (const SweepPoint& point : combinations_of(sweep)) {
            if (!once.contains(text_of(point))) left_out.insert(text_of(point));
        }
    }
    CHECK(left_out.size() == 12);  // any may be the one
    Sweep wide = one_range({.lo = 0, .hi = 1e6, .step = 1, .whole = true});
    const std::vector<std::string> drawn = texts(wide, 3);
    CHECK(std::set<std::string>(drawn.begin(), drawn.end()).size() == 50);
}

TEST_CASE("a range of one number is one value, not as many as there are samples", "[lua][scenario][sweep]") {
    Sweep sweep = one_range({.lo = 1, .hi = 1});
    sweep.samples = 20;
    REQUIRE(draws(sweep, 7).size() == 1);
    CHECK(text_of(draws(sweep, 7).front()) == "[x=1.0]");
    sweep.keys.push_back({"y", SweepRange{.lo = 1, .hi = 3, .step = 1, .whole = true}});
    CHECK(draws(sweep, 7).size() == 3);
    sweep.keys.push_back({"z", SweepRange{.lo = 0, .hi = 1}});
    CHECK(draws(sweep, 7).size() == 20);
}

TEST_CASE("the text of a value in a table has no quotes and no escapes", "[lua][scenario][sweep]") {
    const auto plain = [](const std::string& text) {
        PlainData data;
        data.values.emplace_back(text);
        return plain_text(to_sweep_value(std::move(data)));
    };
    for (const std::string text :
         {"fast", "a b", "x,y", "say \"hi\"", "back\\slash", "\\065", "two\nlines\x7f\x01", ""})
        CHECK(plain(text) == text);
    PlainData number;
    number.values.emplace_back(0.5);
    CHECK(plain_text(to_sweep_value(std::move(number))) == "0.5");
}

TEST_CASE("values of a range without a step are drawn independently", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = 0, .hi = 1});
    const std::vector<SweepPoint> all = draws(sweep, 7);
    REQUIRE(all.size() == 50);
    for (std::size_t i = 0; i < all.size(); ++i) CHECK(all[i] == draw_point(sweep, 7, i));
}

TEST_CASE("a control character in a text appears as its code in the run's name", "[lua][scenario][sweep]") {
    const auto name = [](const std::string& text) { return value(text).text; };
    CHECK(name("a\tb") == "\"a\\x09b\"");
    CHECK(name("\x1f") == "\"\\x1f\"");
    CHECK(name("\x7f") == "\"\\x7f\"");
    CHECK(name(" ") == "\" \"");
    CHECK(name("!") == "!");
    CHECK(name("~") == "~");
    CHECK(name("") == "\"\"");
    CHECK(name("a\"b") == "\"a\\\"b\"");
}

TEST_CASE("no two samples of a range are equal, and the names of few samples are short", "[lua][scenario][sweep]") {
    Sweep sweep = one_range({0, 1});
    for (const std::size_t samples : {50, 200, 5000}) {
        sweep.samples = samples;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            std::set<std::string> names;
            for (const SweepPoint& point : draws(sweep, seed)) names.insert(text_of(point));
            CHECK(names.size() == samples);
            for (const std::string& name : names) CHECK(name.size() <= (samples == 50 ? 10 : 12));
        }
    }
}

TEST_CASE("simplifying ends, because each step is nearer to zero or shorter", "[lua][scenario][sweep]") {
    const Sweep sweep = one_range({.lo = -10, .hi = 10});
    for (std::size_t i = 0; i < 20; ++i) {
        SweepPoint point = draw_point(sweep, 3, i);
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

TEST_CASE("a listed value is simplified to an earlier one", "[lua][scenario][sweep]") {
    const Sweep sweep = two_lists();
    const std::vector<SweepPoint> all = combinations(sweep);
    CHECK(simpler(sweep, all.front()).empty());
    CHECK(simpler(sweep, all[1]) == std::vector<SweepPoint>{all[0]});
}
