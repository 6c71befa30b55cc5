// Columns are in the order of their first runs.
#include "bindings/scenario/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/base/csv.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

constexpr std::array<std::string_view, 4> fixed_columns{"scenario", "run", "seed", "passed"};

// The columns of parameters: no two columns have the same name.
std::vector<std::string> columns_of(const std::vector<std::string>& parameters,
                                    const std::vector<std::string>& measures) {
    std::vector<std::string> columns;
    for (const std::string& name : parameters) {
        std::string column = name;
        while (is_column_of_measures(column) || contains(measures, column) || contains(columns, column) ||
               (column != name && contains(parameters, column)))
            column.insert(0, "p.");
        columns.push_back(std::move(column));
    }
    return columns;
}

}  // namespace

double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(at));
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (sorted[above] - sorted[below]) * (at - std::floor(at));
}

std::vector<MeasureSummary> summarize(const std::vector<MeasuredRun>& runs) {
    std::vector<MeasureSummary> all;
    std::vector<std::vector<double>> values;
    for (const MeasuredRun& run : runs) {
        for (const Measure& measure : run.measures) {
            const auto same = [&](const MeasureSummary& other) {
                return other.scenario == run.scenario && other.name == measure.name && other.unit == measure.unit;
            };
            const auto found = std::find_if(all.begin(), all.end(), same);
            const auto index = static_cast<std::size_t>(found - all.begin());
            if (found == all.end()) {
                all.push_back({.scenario = run.scenario, .name = measure.name, .unit = measure.unit});
                values.emplace_back();
            }
            if (run.counts) {
                values[index].push_back(measure.value);
            } else {
                ++all[index].left_out;
            }
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i) all[i].values = Statistics::of(std::move(values[i]));
    return all;
}

Statistics Statistics::of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {.count = values.size(),
            .min = values.front(),
            .median = quantile(values, 0.5),
            .mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()),
            .max = values.back()};
}

std::string text_of(const Statistics& statistics) {
    if (statistics.count == 0) return "";
    return fmt::format(", min {:.6g}, median {:.6g}, mean {:.6g}, max {:.6g}", statistics.min, statistics.median,
                       statistics.mean, statistics.max);
}

std::string title_of_measure(const std::string& name, const std::string& unit, const std::string& scenario) {
    return fmt::format("{}{} of {}", name, unit.empty() ? "" : fmt::format(" [{}]", unit), scenario);
}

std::string text_of(const MeasureSummary& summary) {
    std::string text = fmt::format("{}: {} run{}{}", title_of_measure(summary.name, summary.unit, summary.scenario),
                                   summary.values.count, summary.values.count == 1 ? "" : "s", text_of(summary.values));
    if (summary.left_out > 0)
        text += fmt::format(" ({} with a component in ERROR, or not run to the end, omitted)", summary.left_out);
    return text;
}

bool is_column_of_measures(std::string_view name) { return contains(fixed_columns, name); }

bool is_measures_csv(std::string_view text) {
    return text.starts_with(fmt::format("{}", fmt::join(fixed_columns, ",")));
}

std::string measures_csv(const std::vector<MeasuredRun>& runs) {
    std::vector<std::string> parameters;
    std::vector<std::string> measures;
    for (const MeasuredRun& run : runs) {
        for (const auto& parameter : run.point) add_once(parameters, parameter.first);
        for (const Measure& measure : run.measures) add_once(measures, measure.name);
    }
    std::vector<std::string> fields(fixed_columns.begin(), fixed_columns.end());
    for (const std::string& column : columns_of(parameters, measures)) fields.push_back(csv_field(column));
    for (const std::string& name : measures) fields.push_back(csv_field(name));
    std::string out = csv_row(fields) + "\n";
    for (const MeasuredRun& run : runs) {
        fields = {csv_field(run.scenario), csv_field(run.name), fmt::to_string(run.seed), fmt::to_string(run.passed)};
        for (const std::string& name : parameters) {
            const auto has = [&](const auto& parameter) { return parameter.first == name; };
            const auto found = std::find_if(run.point.begin(), run.point.end(), has);
            fields.push_back(found == run.point.end() ? "" : csv_field(plain_text(found->second)));
        }
        for (const std::string& name : measures) {
            const auto has = [&](const Measure& measure) { return measure.name == name; };
            const auto found = std::find_if(run.measures.begin(), run.measures.end(), has);
            fields.push_back(found == run.measures.end() ? "" : fmt::to_string(found->value));
        }
        out += csv_row(fields) + "\n";
    }
    return out;
}

}  // namespace nezumi
