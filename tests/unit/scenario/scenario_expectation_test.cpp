// The verdict of an expectation, sample by sample, and its message.
#include <catch2/catch.hpp>

#include "bindings/scenario/expectation.hpp"

using namespace nezumi;
using Kind = Expectation::Kind;

namespace {

// Looks every 10 ms; the condition is true from `from` to `to`. Returns the time of the verdict, -1 when there is none.
double decide(Expectation& expectation, double from, double to, double end = 20) {
    for (int tick = 1; tick * 0.01 <= end; ++tick) {
        const double now = tick * 0.01;
        const bool is_true = now >= from - 1e-9 && now <= to + 1e-9;
        if (expectation.add_sample(is_true, now) != Verdict::open) return now;
    }
    return -1;
}

}  // namespace

TEST_CASE("always fails at the first false sample, and the message has its time", "[lua][scenario][expectation]") {
    Expectation always({.kind = Kind::always, .name = "keeps off"}, 0);
    CHECK(decide(always, 0, 3.11) == Approx(3.12));
    CHECK(always.verdict() == Verdict::broken);
    CHECK(always.explain() == "always 'keeps off' held until 3.11 s and failed at 3.12 s");

    Expectation at_once({.kind = Kind::always, .name = "keeps off"}, 0);
    CHECK(decide(at_once, 1, 2) == Approx(0.01));
    CHECK(at_once.explain() == "always 'keeps off' did not hold at its first sample, at 0.01 s");
}

TEST_CASE("never fails at the first true sample", "[lua][scenario][expectation]") {
    Expectation never({.kind = Kind::never, .name = "touches"}, 0);
    CHECK(decide(never, 1.5, 2) == Approx(1.5));
    CHECK(never.explain() == "never 'touches' happened at 1.50 s");
}

TEST_CASE("eventually passes with one true sample, also the last one", "[lua][scenario][expectation]") {
    Expectation in_time({.kind = Kind::eventually, .name = "stops", .within = 2}, 0);
    CHECK(decide(in_time, 2.0, 9) == Approx(2.0));
    CHECK(in_time.verdict() == Verdict::kept);

    Expectation late({.kind = Kind::eventually, .name = "stops", .within = 2}, 0);
    CHECK(decide(late, 2.01, 9) == Approx(2.0));
    CHECK(late.explain() == "eventually 'stops' did not happen within 2.00 s: waited from 0.00 s to 2.00 s");
}

TEST_CASE("a hold must begin within its time limit, and may end after it", "[lua][scenario][expectation]") {
    Expectation last_moment({.kind = Kind::maintain, .name = "stays", .within = 5, .hold = 2}, 0);
    CHECK(decide(last_moment, 5.0, 7.0) == Approx(7.0));
    CHECK(last_moment.verdict() == Verdict::kept);

    Expectation too_late({.kind = Kind::maintain, .name = "stays", .within = 5, .hold = 2}, 0);
    CHECK(decide(too_late, 5.01, 9) == Approx(5.0));
    CHECK(too_late.explain() == "maintain 'stays' did not begin within 5.00 s: waited from 0.00 s to 5.00 s");
}

TEST_CASE("after a hold that ends early, a later one counts", "[lua][scenario][expectation]") {
    Expectation second({.kind = Kind::maintain, .name = "stays", .within = 5, .hold = 2}, 0);
    double kept_at = -1;
    for (int tick = 1; tick < 1000 && kept_at < 0; ++tick) {
        const double now = tick * 0.01;
        const bool is_true = (now >= 1 && now <= 2) || now >= 4;
        if (second.add_sample(is_true, now) == Verdict::kept) kept_at = now;
    }
    CHECK(kept_at == Approx(6.0));
}

TEST_CASE("the message about a missing hold has the longest one", "[lua][scenario][expectation]") {
    Expectation broken({.kind = Kind::maintain, .name = "stays", .within = 5, .hold = 2}, 0);
    CHECK(decide(broken, 4.0, 5.5) == Approx(5.51));
    CHECK(broken.explain() ==
          "maintain 'stays' held for only 1.50 s of 2.00 s, from 4.00 s to 5.50 s, and no later hold began within "
          "5.00 s");
}

TEST_CASE("without a time limit, only the scenario's timeout ends the wait", "[lua][scenario][expectation]") {
    Expectation waits({.kind = Kind::wait_until, .name = "comes"}, 0);
    CHECK(decide(waits, 100, 101) == -1);
    CHECK(waits.explain_open(20) == "wait_until 'comes' had not happened since 0.00 s");
}

TEST_CASE("times are shown with the necessary digits", "[lua][scenario][expectation]") {
    CHECK(text_of_time(3) == "3.00 s");
    CHECK(text_of_time(3.125) == "3.125 s");
    CHECK(text_of_time(1.0 / 3) == "0.333333 s");
}
