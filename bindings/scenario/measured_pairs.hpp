// Runs that differ in one key of their sweep alone, as two controllers with the same draws: what lies between them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bindings/scenario/measures.hpp"

namespace nezumi {

/// How a measure differs between two values of the key: the second one's minus the first one's, pair by pair.
struct PairSummary {
    std::string scenario;
    std::string name;
    std::string unit;
    std::string key;
    std::string first, second;  ///< values of the key
    Statistics differences{};
    std::size_t less = 0, more = 0;  ///< pairs in which the second one's is less, or more
};

/// Of each measure of each scenario that is paired: the first value of the key with each other one, in the order in
/// which they come first. Only of runs that count; a pair has both.
std::vector<PairSummary> summarize_pairs(const std::vector<MeasuredRun>& runs);

/// "time to goal [s] of drives, controller=b minus controller=a: 20 pairs, min -0.4, ..., max 0.3 (less in 13, more in
/// 7)".
std::string text_of(const PairSummary& summary);

}  // namespace nezumi
