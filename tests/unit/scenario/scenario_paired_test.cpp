// Statistics of differences in pairs, worked by hand.
#include <catch2/catch.hpp>

#include "bindings/scenario/measured_pairs.hpp"
#include "bindings/scenario/paired_statistics.hpp"

using namespace nezumi;

namespace {

MeasuredRun paired_run(const std::string& controller, int number, double value) {
    return {.scenario = "it",
            .name = controller,
            .point = {{"controller", SweepValue{.data = {}, .text = controller}}},
            .paired = "controller",
            .repetition = " #" + std::to_string(number),
            .passed = true,
            .measures = {{"time", value, "s"}}};
}

}  // namespace

TEST_CASE("the sign test has the binomial probability of both tails", "[scenario][paired]") {
    CHECK(sign_test(0, 0) == 1);
    CHECK(sign_test(1, 1) == 1);
    CHECK(sign_test(0, 1) == Approx(1));
    CHECK(sign_test(0, 5) == Approx(2 / 32.0));
    CHECK(sign_test(1, 7) == Approx(2 * (1 + 8) / 256.0));
    // 1 + 20 + 190 + 1140 of 2^20.
    CHECK(sign_test(17, 3) == Approx(2 * 1351 / 1048576.0));
    CHECK(sign_test(3, 17) == sign_test(17, 3));
    CHECK(sign_test(0, 20'000) == 0);
    CHECK(sign_test(10'000, 10'000) == 1);
}

TEST_CASE("the bootstrap interval of a median has the quantiles of the resampled medians", "[scenario][paired]") {
    using Interval = std::pair<double, double>;
    CHECK(median_interval({4}) == Interval{4, 4});
    CHECK(median_interval({4, 4, 4}) == Interval{4, 4});
    // The median of 7 draws is at most 1 if at least 4 are: with p = 0.010; at most 2 with p = 0.108.
    CHECK(median_interval({7, 6, 5, 4, 3, 2, 1}) == Interval{2, 6});
    // Of 9 draws: at most 1 with p = 0.0013, at most 2 with p = 0.030.
    CHECK(median_interval({1, 2, 3, 4, 5, 6, 7, 8, 9}) == Interval{2, 8});
    // Of two values: both draws are 1 with p = 0.25.
    CHECK(median_interval({1, 2}) == Interval{1, 2});
}

TEST_CASE("the summary of pairs shows the differences, their quartiles and how sure they are", "[scenario][paired]") {
    std::vector<MeasuredRun> runs;
    for (int i = 1; i <= 7; ++i) {
        runs.push_back(paired_run("old", i, 10));
        runs.push_back(paired_run("new", i, 10 + (i == 7 ? -1 : i)));
    }
    runs.push_back(paired_run("new", 8, 100));  // has no partner
    // -1, 1, 2, 3, 4, 5, 6
    const auto all = summarize_pairs(runs);
    REQUIRE(all.size() == 1);
    CHECK(text_of(all[0]) ==
          "time [s] of it, controller=new minus controller=old: 7 pairs, min -1, quartiles 1.5 and 4.5, median 3 (95 % "
          "interval 1 to 5), mean 2.85714, max 6; less in 1, more in 6 (sign test: p = 0.125)");
    runs = {paired_run("old", 1, 1), paired_run("new", 2, 1)};
    CHECK(text_of(summarize_pairs(runs)[0]) == "time [s] of it, controller=new minus controller=old: 0 pairs");
}
