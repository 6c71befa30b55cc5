// The margins of the conditions of runs: lines of a report, the least over all runs, and all of them as a table.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/measures.hpp"

namespace nezumi {

/// "always 'keeps off': came within 0.022 m of the limit at 5.12 s (x < 0.5)".
std::string text_of(const ConditionMargin& margin);

/// In failure.txt, this line comes before the conditions of the run, which are the last lines.
inline constexpr std::string_view conditions_heading = "conditions:";

/// The smallest value of all runs, and the run that has it.
struct LeastOfRuns {
    double value = 0;
    double time = 0;  ///< [s] simulated
    std::string run;
};

/// The least margin of one condition over the runs of a scenario.
struct MarginSummary {
    std::string scenario;
    std::string kind;
    std::string condition;
    std::string unit;
    std::size_t count = 0;                  ///< number of times that it was a condition of a run
    std::size_t without = 0;                ///< number of these that have no margin
    std::optional<LeastOfRuns> least{};     ///< margin of its comparisons
    std::optional<LeastOfRuns> earliest{};  ///< time left to the deadline [s]
    std::string why{};                      ///< the reason of the first one without a margin
};

/// For each condition of each scenario that has several runs, in the order of their first runs. Margins in other units
/// than the first one's do not count. Only valid runs count.
std::vector<MarginSummary> summarize_margins(const std::vector<MeasuredRun>& runs);

/// For example "always 'keeps off' of avoid_wall: least margin of 20 runs 0.022 m, at 5.12 s of avoid_wall
/// [speed=0.3]".
std::string text_of(const MarginSummary& summary);

/// CSV (RFC 4180): a row for each condition of each run, with the columns scenario, run, seed, condition, kind, margin,
/// unit, time, left, why. A value that is unknown is an empty cell.
std::string margins_csv(const std::vector<MeasuredRun>& runs);

/// Whether a text begins as `margins_csv` does.
bool is_margins_csv(std::string_view text);

}  // namespace nezumi
