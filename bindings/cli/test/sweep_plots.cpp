// Groups numbers if there are many; other values are shown side by side. A second parameter with few values gives one
// series for each of its values.
#include "bindings/cli/test/sweep_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "bindings/scenario/failure_folder.hpp"
#include "engine/base/list.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi::cli {
namespace {

using draw::SweepPlot;

constexpr std::size_t most_groups = 20;  // with more values, they are grouped
constexpr std::size_t ranges = 10;       // number of groups
constexpr std::size_t most_series = 6;   // values of a second parameter

// One run's values of the parameters and of the measure.
struct Sample {
    std::string text;
    std::string by;
    double value;
};

// The positions of values on the axis: the values, or, if there are too many, the middles of equal ranges.
class Places {
public:
    explicit Places(const std::vector<Sample>& samples) {
        std::set<double> values;
        for (const Sample& sample : samples) values.insert(*finite_in(sample.text));
        low_ = *values.begin();
        if (values.size() > most_groups) size_ = (*values.rbegin() - low_) / static_cast<double>(ranges);
    }
    double of(double value) const {
        if (size_ == 0) return value;
        const auto range = std::min(static_cast<std::size_t>((value - low_) / size_), ranges - 1);
        return low_ + (static_cast<double>(range) + 0.5) * size_;
    }

private:
    double low_ = 0;
    double size_ = 0;  // of a range; 0: there are no ranges
};

// The different texts: numbers in ascending order, others in the order of first occurrence.
std::vector<std::string> different(const std::vector<Sample>& samples, std::string Sample::*text) {
    std::vector<std::string> found;
    for (const Sample& sample : samples) {
        add_once(found, sample.*text);
    }
    const auto is_number = [](const std::string& each) { return finite_in(each).has_value(); };
    if (std::all_of(found.begin(), found.end(), is_number))
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return *finite_in(a) < *finite_in(b); });
    return found;
}

void add_series(SweepPlot& plot, const std::vector<Sample>& samples) {
    const auto is_number = [](const Sample& each) { return finite_in(each.text).has_value(); };
    plot.is_numeric = std::all_of(samples.begin(), samples.end(), is_number);
    if (!plot.is_numeric) plot.labels = different(samples, &Sample::text);
    const auto places = plot.is_numeric ? std::optional(Places(samples)) : std::nullopt;
    for (const std::string& by : different(samples, &Sample::by)) {
        SweepPlot::Series& series = plot.series.emplace_back(SweepPlot::Series{.label = by, .groups = {}});
        std::map<double, std::vector<double>> groups;
        for (const Sample& sample : samples) {
            if (sample.by != by) continue;
            const double at = plot.is_numeric
                                  ? *finite_in(sample.text)
                                  : static_cast<double>(std::find(plot.labels.begin(), plot.labels.end(), sample.text) -
                                                        plot.labels.begin());
            series.points.push_back({at, sample.value});
            groups[places ? places->of(at) : at].push_back(sample.value);
        }
        for (auto& [at, values] : groups) {
            std::sort(values.begin(), values.end());
            const std::string label = places ? fmt::format("{:.6g}", at) : plot.labels[static_cast<std::size_t>(at)];
            series.groups.push_back(
                {at, label, values, quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)});
        }
    }
}

// The plot of a measure over a parameter. Nothing if the parameter has only one value, or if the parameter `by` has
// only one or too many.
std::optional<SweepPlot> plot_of(const std::string& scenario, const std::string& measure, const std::string& unit,
                                 const std::string& parameter, const std::string& by,
                                 const std::vector<Sample>& samples) {
    if (different(samples, &Sample::text).size() < 2) return std::nullopt;
    const std::size_t series = different(samples, &Sample::by).size();
    if (!by.empty() && (series < 2 || series > most_series)) return std::nullopt;
    SweepPlot plot;
    const std::string over = by.empty() ? parameter : fmt::format("{} by {}", parameter, by);
    plot.title = fmt::format("{}: {} over {}", scenario, measure, over);
    plot.parameter = parameter;
    plot.by = by;
    plot.measure = unit.empty() ? measure : fmt::format("{} [{}]", measure, unit);
    plot.file = run_file_name({}, fmt::format("{} {} over {}", scenario, measure, over), true) + ".svg";
    add_series(plot, samples);
    return plot;
}

}  // namespace

std::vector<SweepPlot> sweep_plots(const std::vector<MeasuredRun>& runs) {
    // By scenario, measure, unit, parameter and second parameter, in the order of first occurrence.
    using Key = std::tuple<std::string, std::string, std::string, std::string, std::string>;
    std::vector<Key> keys;
    std::map<Key, std::vector<Sample>> samples;
    for (const MeasuredRun& run : runs) {
        if (!run.counts) continue;
        for (const Measure& measure : run.measures) {
            for (const auto& swept : run.point) {
                const auto add = [&](const std::string& by, const std::string& text) {
                    const Key key{run.scenario, measure.name, measure.unit, swept.first, by};
                    std::vector<Sample>& all = samples[key];
                    if (all.empty()) keys.push_back(key);
                    all.push_back({swept.second.text, text, measure.value});
                };
                add("", "");
                for (const auto& [second, value] : run.point) {
                    if (second != swept.first) add(second, value.text);
                }
            }
        }
    }
    std::vector<SweepPlot> plots;
    for (const Key& key : keys) {
        const auto& [scenario, measure, unit, parameter, by] = key;
        if (auto plot = plot_of(scenario, measure, unit, parameter, by, samples[key]))
            plots.push_back(std::move(*plot));
    }
    return plots;
}

}  // namespace nezumi::cli
