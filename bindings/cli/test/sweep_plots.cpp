// Groups numbers if there are many; other values are shown side by side.
#include "bindings/cli/test/sweep_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <tuple>

#include "bindings/scenario/failure_folder.hpp"

namespace nezumi::cli {
namespace {

using draw::SweepPlot;

constexpr std::size_t most_groups = 20;  // with more values, they are grouped
constexpr std::size_t ranges = 10;       // number of groups

// One run's value of the parameter and of the measure.
struct Sample {
    std::string text;
    double value;
};

std::optional<double> to_number(const std::string& text) {
    double number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
}

void sort_groups(SweepPlot& plot) {
    for (SweepPlot::Group& group : plot.groups) {
        std::sort(group.sorted.begin(), group.sorted.end());
        group.lower = quantile(group.sorted, 0.25);
        group.median = quantile(group.sorted, 0.5);
        group.upper = quantile(group.sorted, 0.75);
    }
}

// One group per value, or `ranges` equal groups if there are too many values.
void group_numbers(SweepPlot& plot) {
    std::map<double, std::vector<double>> by_value;
    for (const SweepPlot::Point& point : plot.points) by_value[point.at].push_back(point.value);
    if (by_value.size() <= most_groups) {
        for (const auto& [at, values] : by_value) plot.groups.push_back({at, fmt::format("{:.6g}", at), values});
        return sort_groups(plot);
    }
    const double low = by_value.begin()->first;
    const double size = (by_value.rbegin()->first - low) / static_cast<double>(ranges);
    std::map<std::size_t, std::vector<double>> by_range;
    for (const SweepPlot::Point& point : plot.points) {
        const auto range = static_cast<std::size_t>((point.at - low) / size);
        by_range[std::min(range, ranges - 1)].push_back(point.value);
    }
    for (const auto& [range, values] : by_range) {
        const double at = low + (static_cast<double>(range) + 0.5) * size;
        plot.groups.push_back({at, fmt::format("{:.6g}", at), values});
    }
    sort_groups(plot);
}

// Side by side, in the order of first occurrence.
void group_texts(SweepPlot& plot, const std::vector<Sample>& samples) {
    for (const Sample& sample : samples) {
        const auto same = [&](const SweepPlot::Group& group) { return group.label == sample.text; };
        auto found = std::find_if(plot.groups.begin(), plot.groups.end(), same);
        if (found == plot.groups.end()) {
            plot.groups.push_back({static_cast<double>(plot.groups.size()), sample.text, {}});
            found = plot.groups.end() - 1;
        }
        found->sorted.push_back(sample.value);
        plot.points.push_back({found->at, sample.value});
    }
    sort_groups(plot);
}

void group(SweepPlot& plot, const std::vector<Sample>& samples) {
    plot.is_numeric = std::all_of(samples.begin(), samples.end(),
                                  [](const Sample& each) { return to_number(each.text).has_value(); });
    if (!plot.is_numeric) return group_texts(plot, samples);
    for (const Sample& sample : samples) plot.points.push_back({*to_number(sample.text), sample.value});
    group_numbers(plot);
}

}  // namespace

std::vector<SweepPlot> sweep_plots(const std::vector<MeasuredRun>& runs) {
    // By scenario, measure, unit and parameter, in the order of first occurrence.
    using Key = std::tuple<std::string, std::string, std::string, std::string>;
    std::vector<Key> keys;
    std::map<Key, std::vector<Sample>> samples;
    for (const MeasuredRun& run : runs) {
        if (!run.counts) continue;
        for (const Measure& measure : run.measures) {
            for (const auto& [parameter, value] : run.point) {
                const Key key{run.scenario, measure.name, measure.unit, parameter};
                std::vector<Sample>& all = samples[key];
                if (all.empty()) keys.push_back(key);
                all.push_back({value.text, measure.value});
            }
        }
    }
    std::vector<SweepPlot> plots;
    for (const Key& key : keys) {
        const auto& [scenario, measure, unit, parameter] = key;
        const std::vector<Sample>& all = samples[key];
        const auto first = [&](const Sample& each) { return each.text == all.front().text; };
        if (std::all_of(all.begin(), all.end(), first)) continue;
        SweepPlot plot;
        plot.title = fmt::format("{}: {} over {}", scenario, measure, parameter);
        plot.parameter = parameter;
        plot.measure = unit.empty() ? measure : fmt::format("{} [{}]", measure, unit);
        plot.file = run_file_name({}, fmt::format("{} {} over {}", scenario, measure, parameter), true) + ".svg";
        group(plot, all);
        plots.push_back(std::move(plot));
    }
    return plots;
}

}  // namespace nezumi::cli
