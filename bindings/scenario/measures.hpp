// Numbers that runs record with `s:measure`: statistics, and all of them as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/sweep.hpp"

namespace nezumi {

/// The measures of one run.
struct MeasuredRun {
    std::string scenario;  ///< its name, and its file if other files have a scenario of that name
    std::string name;      ///< with the values of its sweep
    SweepPoint point;
    std::uint64_t seed = 0;
    std::string paired{};      ///< the key of the sweep whose values are compared; "" for none
    std::string repetition{};  ///< the part of its name after the values
    bool passed = false;
    std::vector<Measure> measures;
    std::vector<ConditionMargin> margins{};
    bool counts = true;  ///< false: after an ERROR, or if the run could not be made, measures mean nothing
};

/// Statistics of several values.
struct Statistics {
    std::size_t count = 0;
    double min = 0;
    double median = 0;
    double mean = 0;
    double max = 0;

    static Statistics of(std::vector<double> values);
};

/// The statistics of one measure over the runs of a scenario.
struct MeasureSummary {
    std::string scenario;
    std::string name;
    std::string unit;
    Statistics values{};
    std::size_t left_out = 0;  ///< number of runs that measured it but are not valid
};

/// The quantile of `share` (0 to 1), by linear interpolation between two values (type 7 of Hyndman and Fan 1996, as in
/// R and NumPy). `sorted` has at least one value, in ascending order.
double quantile(const std::vector<double>& sorted, double share);

/// ", min 3.2, median 4, mean 4.1, max 6"; "" without values.
std::string text_of(const Statistics& statistics);
/// "time to goal [s] of drives".
std::string title_of_measure(const std::string& name, const std::string& unit, const std::string& scenario);

/// For each measure of each scenario, in the order of their first runs. Only valid runs count.
std::vector<MeasureSummary> summarize(const std::vector<MeasuredRun>& runs);

/// "time to goal [s] of drives: 20 runs, min 3.2, median 4, mean 4.1, max 6", and the number of runs that are left out.
std::string text_of(const MeasureSummary& summary);

/// CSV (RFC 4180): a row for each run, with the columns scenario, run, seed, passed, the parameters and the measures.
/// Texts have no Lua quotes. A value that a run does not have is an empty cell. A parameter with the name of another
/// column is called `p.NAME`, or `p.p.NAME` if this is taken too.
std::string measures_csv(const std::vector<MeasuredRun>& runs);

/// Whether a text begins as `measures_csv` does.
bool is_measures_csv(std::string_view text);

/// Whether a measure may not have this name, because another column has it.
bool is_column_of_measures(std::string_view name);

}  // namespace nezumi
