// A histogram whose class widths grow with the values.
#include "engine/system/lateness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nezumi {
namespace {

constexpr double unit = 1e-6;  // [s] the classes are linear far below this and logarithmic far above it

}  // namespace

std::size_t Lateness::class_of(double seconds) {
    const double octave = std::log2(1 + seconds / unit);
    const auto number = static_cast<std::size_t>(octave * classes);
    return std::min(number, std::size_t{classes * octaves - 1});
}

double Lateness::upper_end(std::size_t number) {
    return (std::exp2(static_cast<double>(number + 1) / classes) - 1) * unit;
}

void Lateness::add(double seconds, double period) {
    latest_ = std::max(0.0, seconds);
    worst_ = std::max(worst_, latest_);
    if (latest_ > period / 10) ++late_;
    ++ticks_;
    ++counts_[class_of(latest_)];
}

void Lateness::add(const Lateness& later) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += later.counts_[i];
    ticks_ += later.ticks_;
    late_ += later.late_;
    skipped_ += later.skipped_;
    latest_ = later.latest_;
    worst_ = std::max(worst_, later.worst_);
}

double Lateness::quantile(double part) const {
    const auto wanted = static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(ticks_)));
    std::uint64_t passed = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        passed += counts_[i];
        if (passed > 0 && passed >= wanted) return std::min(upper_end(i), worst_);
    }
    return worst_;
}

std::string to_text(const Lateness& lateness) {
    return fmt::format("p50 {:.2f} ms, p99 {:.2f} ms, worst {:.2f} ms", lateness.quantile(0.5) * 1e3,
                       lateness.quantile(0.99) * 1e3, lateness.worst() * 1e3);
}

}  // namespace nezumi
