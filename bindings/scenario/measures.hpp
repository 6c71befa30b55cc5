// Numbers that runs keep by `s:measure`: their statistics, and all of them as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/sweep.hpp"

namespace nezumi {

/// What one run measured.
struct MeasuredRun {
    std::string scenario;  ///< its name
    std::string name;      ///< with the values of its sweep
    SweepPoint point;
    std::uint64_t seed = 0;
    std::string paired{};      ///< the key of the sweep whose values are compared; "" for none
    std::string repetition{};  ///< what its name has after the values
    bool passed = false;
    std::vector<Measure> measures;
    bool counts = true;  ///< false: a component went to ERROR, or it could not be run; what it measured says nothing
};

/// What several values came to.
struct Statistics {
    std::size_t count = 0;
    double min = 0;
    double median = 0;
    double mean = 0;
    double max = 0;

    static Statistics of(std::vector<double> values);
};

/// What the runs of a scenario came to in one measure.
struct MeasureSummary {
    std::string scenario;
    std::string name;
    std::string unit;
    Statistics values{};
    std::size_t left_out = 0;  ///< runs that measured it and do not count
};

/// The value below which this share (0 to 1) of the values lies, between two of them by linear interpolation (type 7 of
/// Hyndman and Fan 1996, as R and NumPy have it). Of at least one value, in ascending order.
double quantile(const std::vector<double>& sorted, double share);

/// ", min 3.2, median 4, mean 4.1, max 6"; "" of no values.
std::string text_of(const Statistics& statistics);
/// "time to goal [s] of drives".
std::string title_of_measure(const std::string& name, const std::string& unit, const std::string& scenario);

/// Of each measure of each scenario, in the order in which they come first. Only of runs that count.
std::vector<MeasureSummary> summarize(const std::vector<MeasuredRun>& runs);

/// "time to goal [s] of drives: 20 runs, min 3.2, median 4, mean 4.1, max 6", and how many
/// runs are left out.
std::string text_of(const MeasureSummary& summary);

/// CSV (RFC 4180): a row for each run, the columns scenario, run, seed, passed, the parameters and the measures. A text
/// is itself, without Lua's quotes. What a run does not have is an empty cell. A parameter that is called like another
/// column is called `p.NAME`, or `p.p.NAME` where that is another one too.
std::string measures_csv(const std::vector<MeasuredRun>& runs);

/// Whether a text begins as `measures_csv` does.
bool is_measures_csv(std::string_view text);

/// Whether a measure may not be called so: it is another column.
bool is_column_of_measures(std::string_view name);

}  // namespace nezumi
