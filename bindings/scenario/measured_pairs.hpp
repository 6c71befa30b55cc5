// Compares runs in pairs that differ only in one key of their sweep, such as two controllers with the same draws.
#pragma once

#include <cstddef>
#include <string>
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
    std::size_t less = 0, more = 0;  ///< number of pairs in which the second value is less, or more
};

/// For each measure of each paired scenario: the first value of the key compared with each other value, in the order of
/// their first runs. Uses only pairs of two valid runs.
std::vector<PairSummary> summarize_pairs(const std::vector<MeasuredRun>& runs);

/// "time to goal [s] of drives, controller=b minus controller=a: 20 pairs, min -0.4, ..., max 0.3 (less in 13, more in
/// 7)".
std::string text_of(const PairSummary& summary);

}  // namespace nezumi
