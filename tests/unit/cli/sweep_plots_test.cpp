// Measures over the parameters of a sweep: which plots there are, what they group, what they draw.
#include "bindings/cli/test/sweep_plots.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::cli;
using draw::SweepPlot;

namespace {

MeasuredRun run(const std::string& speed, const std::string& kind, double time) {
    const auto value = [](const std::string& text) { return SweepValue{.data = {}, .text = text}; };
    return {.scenario = "drives",
            .name = "",
            .point = {{"kind", value(kind)}, {"speed", value(speed)}},
            .passed = true,
            .measures = {{"time", time, "s"}}};
}

}  // namespace

TEST_CASE("there is a plot for each measure over each parameter that has several values", "[cli][plot]") {
    const auto plots = sweep_plots({run("0.2", "a", 5), run("0.1", "a", 7), run("0.1", "a", 1), run("0.1", "a", 3)});
    REQUIRE(plots.size() == 1);  // kind is always the same
    const SweepPlot& plot = plots.front();
    CHECK(plot.title == "drives: time over speed");
    CHECK(plot.measure == "time [s]");
    CHECK(plot.file == "drives-time-over-speed.svg");
    CHECK(plot.is_numeric);
    CHECK(plot.series[0].points.size() == 4);
    REQUIRE(plot.series[0].groups.size() == 2);
    CHECK(plot.series[0].groups[0].at == 0.1);
    CHECK(plot.series[0].groups[0].sorted == std::vector<double>{1, 3, 7});
    CHECK(plot.series[0].groups[0].lower == 2);
    CHECK(plot.series[0].groups[0].median == 3);
    CHECK(plot.series[0].groups[0].upper == 5);
    CHECK(plot.series[0].groups[1].sorted == std::vector<double>{5});
    CHECK(sweep_plots({}).empty());
}

TEST_CASE("values that are not numbers are placed side by side", "[cli][plot]") {
    const auto plots = sweep_plots({run("1", "slow", 1), run("1", "fast", 2), run("1", "slow", 0)});
    REQUIRE(plots.size() == 1);
    CHECK_FALSE(plots[0].is_numeric);
    REQUIRE(plots[0].series[0].groups.size() == 2);
    CHECK(plots[0].series[0].groups[0].label == "slow");
    CHECK(plots[0].series[0].groups[0].sorted == std::vector<double>{0, 1});
    CHECK(plots[0].series[0].groups[1].at == 1);
}

TEST_CASE("a second parameter with few values gives a plot with a series for each", "[cli][plot]") {
    const auto plots = sweep_plots({run("0.1", "a", 1), run("0.2", "a", 2), run("0.2", "a", 4), run("0.1", "b", 5)});
    std::vector<std::string> files(plots.size());
    std::transform(plots.begin(), plots.end(), files.begin(), [](const SweepPlot& plot) { return plot.file; });
    CHECK(files == std::vector<std::string>{"drives-time-over-kind.svg", "drives-time-over-kind-by-speed.svg",
                                            "drives-time-over-speed.svg", "drives-time-over-speed-by-kind.svg"});
    const SweepPlot& by_kind = plots.at(3);
    CHECK(by_kind.title == "drives: time over speed by kind");
    CHECK(by_kind.by == "kind");
    CHECK(by_kind.is_numeric);
    REQUIRE(by_kind.series.size() == 2);
    CHECK(by_kind.series[0].label == "a");
    REQUIRE(by_kind.series[0].groups.size() == 2);
    CHECK(by_kind.series[0].groups[1].sorted == std::vector<double>{2, 4});
    CHECK(by_kind.series[1].label == "b");
    REQUIRE(by_kind.series[1].groups.size() == 1);
    CHECK(by_kind.series[1].points.size() == 1);
    const SweepPlot& by_speed = plots.at(1);
    CHECK_FALSE(by_speed.is_numeric);
    CHECK(by_speed.labels == std::vector<std::string>{"a", "b"});
    CHECK(by_speed.series[1].label == "0.2");
    const Scratch scratch;
    for (const SweepPlot& plot : plots) {
        REQUIRE(draw::draw_sweep_plot(plot, scratch.path("")));
        CHECK(text_of_file(scratch.path(plot.file)).starts_with("<?xml"));
    }
}

TEST_CASE("all series use the same ranges of a parameter, and one with more than six values gives no series",
          "[cli][plot]") {
    std::vector<MeasuredRun> runs;
    for (int i = 0; i <= 100; ++i) runs.push_back(run(std::to_string(i), i % 2 == 0 ? "a" : "b", i));
    const auto plots = sweep_plots(runs);  // not over kind by speed, which has 101 values
    REQUIRE(plots.size() == 3);
    const SweepPlot& by_kind = plots.at(2);
    REQUIRE(by_kind.series.size() == 2);
    REQUIRE(by_kind.series[0].groups.size() == 10);
    for (std::size_t i = 0; i < 10; ++i) CHECK(by_kind.series[0].groups[i].at == by_kind.series[1].groups[i].at);
    runs.clear();
    for (int i = 0; i < 7; ++i) runs.push_back(run("1", std::to_string(i), i));
    CHECK(sweep_plots(runs).size() == 1);
}

TEST_CASE("many different numbers are put together in ranges", "[cli][plot]") {
    std::vector<MeasuredRun> runs;
    for (int i = 0; i <= 100; ++i) runs.push_back(run(std::to_string(i), "a", i));
    const auto plots = sweep_plots(runs);
    REQUIRE(plots.size() == 1);
    REQUIRE(plots[0].series[0].groups.size() == 10);
    CHECK(plots[0].series[0].groups[0].at == 5);
    CHECK(plots[0].series[0].groups[0].sorted.size() == 10);
    CHECK(plots[0].series[0].groups[9].sorted.size() == 11);  // the greatest belongs to the last
    CHECK(plots[0].series[0].points.size() == 101);
}

TEST_CASE("a plot is SVG, or an error and no file", "[cli][plot]") {
    const Scratch scratch;
    for (const auto& runs : {std::vector<MeasuredRun>{run("1", "a", 2), run("2", "a", 2)},
                             std::vector<MeasuredRun>{run("1", "a", 1e300), run("1", "b", -1e300), run("1", "b", 0)}}) {
        const auto plots = sweep_plots(runs);
        REQUIRE(plots.size() == 1);
        REQUIRE(draw::draw_sweep_plot(plots[0], scratch.path("")));
        const std::string svg = text_of_file(scratch.path(plots[0].file));
        CHECK(svg.starts_with("<?xml"));
        CHECK(svg.find("nan") == std::string::npos);
        CHECK(svg.find("inf") == std::string::npos);
        CHECK_FALSE(draw::draw_sweep_plot(plots[0], scratch.path("none")));
    }
}

TEST_CASE("nezumi test --plots draws what was measured over what was swept", "[cli][test][plot]") {
    const Scratch scratch;
    scratch.write("it_test.lua",
                  "scenario('it', { sweep = { x = { 1, 2, 3 } } }, function(s, p) s:measure('square', p.x * p.x) end)\n"
                  "scenario('alone', function(s) s:measure('one', 1) end)\n");
    const auto test = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"test", "it_test.lua"});
        return run_nezumi(std::move(words), scratch.path("").string());
    };
    CHECK(test({"--plots", "deep/plots"}).status == 0);
    CHECK(text_of_file(scratch.path("deep/plots/it-square-over-x.svg")).starts_with("<?xml"));
    CHECK(test({"--plots", "none", "--filter", "alone"}).error ==
          "nezumi: --plots: nothing was measured over a swept parameter\n");
    CHECK(test({"--plots", "it_test.lua/x"}).error == "it_test.lua/x: can't be made: Not a directory\n");
}
