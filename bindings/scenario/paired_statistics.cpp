// Sums binomial probabilities by their logarithms, so that many pairs do not overflow.
#include "bindings/scenario/paired_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bindings/lua/sandbox/random.hpp"
#include "bindings/scenario/measures.hpp"

namespace nezumi {
namespace {

constexpr int bootstrap_samples = 10'000;
constexpr std::uint64_t bootstrap_seed = 124;
constexpr double confidence = 0.95;

// Changes the order of the values.
double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace

std::pair<double, double> median_interval(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    Random random(bootstrap_seed, 0);
    std::vector<double> sample(values.size());
    std::vector<double> medians(bootstrap_samples);
    for (double& median : medians) {
        for (double& drawn : sample) drawn = values[random.next_up_to(values.size() - 1)];
        median = median_of(sample);
    }
    std::sort(medians.begin(), medians.end());
    return {quantile(medians, (1 - confidence) / 2), quantile(medians, (1 + confidence) / 2)};
}

double sign_test(std::size_t less, std::size_t more) {
    const auto all = static_cast<double>(less + more);
    double tail = 0;
    for (std::size_t i = 0; i <= std::min(less, more); ++i) {
        const auto count = static_cast<double>(i);
        const double ways = std::lgamma(all + 1) - std::lgamma(count + 1) - std::lgamma(all - count + 1);
        tail += std::exp(ways - all * std::log(2.0));
    }
    return std::min(1.0, 2 * tail);
}

}  // namespace nezumi
