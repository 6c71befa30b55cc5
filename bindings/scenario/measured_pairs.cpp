// A pair is two runs of one scenario with the same values of all other keys, and the same repetition.
#include "bindings/scenario/measured_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "bindings/scenario/paired_statistics.hpp"

namespace nezumi {
namespace {

// The values of one measure for one value of the key, by the common part of the pairs.
struct Side {
    std::string value;
    std::map<std::string, double> measured{};
    std::set<std::string> failed{};  // without a value
};

struct Compared {
    std::string scenario, name, unit, key;
    std::vector<Side> sides{};
};

std::vector<Compared> compared(const std::vector<MeasuredRun>& runs) {
    std::vector<Compared> all;
    for (const MeasuredRun& run : runs) {
        if (!run.counts || run.paired.empty()) continue;
        for (const Measure& measure : run.measures) {
            const auto same = [&](const Compared& other) {
                return std::tie(other.scenario, other.name, other.unit) ==
                       std::tie(run.scenario, measure.name, measure.unit);
            };
            if (std::none_of(all.begin(), all.end(), same))
                all.push_back({run.scenario, measure.name, measure.unit, run.paired});
        }
    }
    for (Compared& each : all) {
        for (const MeasuredRun& run : runs) {
            const auto is_key = [&](const auto& value) { return value.first == each.key; };
            const auto own = std::find_if(run.point.begin(), run.point.end(), is_key);
            if (run.scenario != each.scenario || own == run.point.end()) continue;
            const std::string common = text_of(without(run.point, each.key)) + run.repetition;
            const auto is_value = [&](const Side& side) { return side.value == own->second.text; };
            auto side = std::find_if(each.sides.begin(), each.sides.end(), is_value);
            if (side == each.sides.end()) side = each.sides.insert(each.sides.end(), {own->second.text});
            const auto is_it = [&](const Measure& m) { return m.name == each.name && m.unit == each.unit; };
            const auto measure = std::find_if(run.measures.begin(), run.measures.end(), is_it);
            if (run.counts && measure != run.measures.end()) {
                side->measured.emplace(common, measure->value);
            } else if (!run.passed) {
                side->failed.insert(common);
            }
        }
    }
    return all;
}

}  // namespace

std::vector<PairSummary> summarize_pairs(const std::vector<MeasuredRun>& runs) {
    std::vector<PairSummary> summaries;
    for (const Compared& each : compared(runs)) {
        const Side& first = each.sides.front();
        for (auto second = each.sides.begin() + 1; second != each.sides.end(); ++second) {
            PairSummary summary{each.scenario, each.name, each.unit, each.key, first.value, second->value};
            std::vector<double> differences;
            for (const auto& [common, value] : second->measured) {
                const auto other = first.measured.find(common);
                if (other == first.measured.end()) continue;
                differences.push_back(value - other->second);
                if (value < other->second) ++summary.less;
                if (value > other->second) ++summary.more;
            }
            for (const auto& [one, other] : {std::pair(&first, &*second), std::pair(&*second, &first)}) {
                for (const std::string& common : one->failed)
                    summary.left_out +=
                        other->measured.contains(common) || (one == &first && other->failed.contains(common)) ? 1 : 0;
            }
            std::sort(differences.begin(), differences.end());
            if (!differences.empty()) {
                summary.lower_quartile = quantile(differences, 0.25);
                summary.upper_quartile = quantile(differences, 0.75);
                summary.median_interval = median_interval(differences);
            }
            summary.differences = Statistics::of(std::move(differences));
            summaries.push_back(std::move(summary));
        }
    }
    return summaries;
}

std::string text_of(const PairSummary& summary) {
    const Statistics& differences = summary.differences;
    std::string pairs = fmt::format(
        "{0}, {1}={2} minus {1}={3}: {4} pair{5}", title_of_measure(summary.name, summary.unit, summary.scenario),
        summary.key, summary.second, summary.first, differences.count, differences.count == 1 ? "" : "s");
    if (summary.left_out > 0)
        pairs += fmt::format(" ({} pair{} left out: a run failed)", summary.left_out, summary.left_out == 1 ? "" : "s");
    if (differences.count == 0) return pairs;
    return pairs + fmt::format(
                       ", min {:.6g}, quartiles {:.6g} and {:.6g}, median {:.6g} (95 % interval {:.6g} to {:.6g}), "
                       "mean {:.6g}, max {:.6g}; less in {}, more in {} (sign test: p = {:.3g})",
                       differences.min, summary.lower_quartile, summary.upper_quartile, differences.median,
                       summary.median_interval.first, summary.median_interval.second, differences.mean, differences.max,
                       summary.less, summary.more, sign_test(summary.less, summary.more));
}

}  // namespace nezumi
