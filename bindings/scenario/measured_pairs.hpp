// Compares runs in pairs that differ only in one key of their sweep, such as two controllers with the same draws.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bindings/scenario/measures.hpp"

namespace nezumi {

/// The differences of a measure between two values of the key: the second minus the first, for each pair.
struct PairSummary {
    std::string scenario;
    std::string name;
    std::string unit;
    std::string key;
    std::string first, second;  ///< values of the key
    Statistics differences{};
    double lower_quartile = 0, upper_quartile = 0;
    std::pair<double, double> median_interval{};  ///< contains the median with a confidence of 95 %
    std::size_t less = 0, more = 0;               ///< number of pairs in which the second value is less, or more
    std::size_t left_out = 0;                     ///< number of pairs of which a run failed before it had a value
};

/// For each measure of each paired scenario: the first value of the key compared with each other value, in the order of
/// their first runs. Uses only pairs of two valid runs.
std::vector<PairSummary> summarize_pairs(const std::vector<MeasuredRun>& runs);

/// "time to goal [s] of drives, controller=b minus controller=a: 20 pairs, min -0.4, quartiles -0.2 and 0.1, median
/// -0.1 (95 % interval -0.2 to 0.1), mean -0.1, max 0.3; less in 13, more in 7 (sign test: p = 0.263)".
std::string text_of(const PairSummary& summary);

}  // namespace nezumi
