// Statistics of paired differences: the confidence interval of a median, and the sign test.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace nezumi {

/// The interval that contains 95 % of the medians of 10 000 bootstrap samples (percentile bootstrap, Efron and
/// Tibshirani 1993, chapter 13). The draws are the same each time. At least one value, in any order.
std::pair<double, double> median_interval(std::vector<double> values);

/// The two-sided p of the sign test: the probability that so few differences have one of the signs, if both signs have
/// the same probability. Differences of 0 do not count. 1 without any difference.
double sign_test(std::size_t less, std::size_t more);

}  // namespace nezumi
