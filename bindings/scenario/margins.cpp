// Rows are in the order of the runs, and of the conditions in each run.
#include "bindings/scenario/margins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bindings/scenario/condition.hpp"
#include "bindings/scenario/expectation.hpp"
#include "engine/base/csv.hpp"

namespace nezumi {
namespace {

constexpr std::string_view margin_columns = "scenario,run,seed,condition,kind,margin,unit,time,left,why";

void take_least(std::optional<LeastOfRuns>& least, double value, double time, const std::string& run) {
    if (!least || value < least->value) least = {value, time, run};
}

std::string cell(const std::optional<double>& number) { return number ? fmt::to_string(*number) : ""; }

}  // namespace

std::string text_of(const ConditionMargin& margin) {
    std::string text = fmt::format("{} '{}': ", margin.kind, margin.condition);
    if (!margin.margin) return text + fmt::format("no margin: {}", margin.why);
    if (margin.left && margin.kind != "maintain")
        return text +
               fmt::format("{} before its deadline, at {}", text_of_time(*margin.left), text_of_time(margin.time));
    if (margin.comparison.empty())
        return text + fmt::format("began {} before its deadline", text_of_time(*margin.left));
    const std::string at = fmt::format(" at {} ({})", text_of_time(margin.time), margin.comparison);
    if (*margin.margin < 0)
        return text + fmt::format("beyond the limit by {}", text_of_number(-*margin.margin, margin.unit)) + at;
    return text + fmt::format("came within {} of the limit", text_of_number(*margin.margin, margin.unit)) + at;
}

std::vector<MarginSummary> summarize_margins(const std::vector<MeasuredRun>& runs) {
    std::map<std::string, std::size_t> run_count;
    for (const MeasuredRun& run : runs) ++run_count[run.scenario];
    std::vector<MarginSummary> all;
    for (const MeasuredRun& run : runs) {
        if (!run.counts || run_count[run.scenario] < 2) continue;
        for (const ConditionMargin& margin : run.margins) {
            const auto same = [&](const MarginSummary& other) {
                return other.scenario == run.scenario && other.kind == margin.kind &&
                       other.condition == margin.condition;
            };
            auto found = std::find_if(all.begin(), all.end(), same);
            if (found == all.end())
                found = all.insert(all.end(), {run.scenario, margin.kind, margin.condition, margin.unit});
            ++found->count;
            if (margin.left) take_least(found->earliest, *margin.left, margin.time, run.name);
            if (!margin.margin) {
                ++found->without;
                if (found->why.empty()) found->why = margin.why;
            } else if (!margin.comparison.empty()) {
                if (!found->least) found->unit = margin.unit;
                if (found->unit == margin.unit) take_least(found->least, *margin.margin, margin.time, run.name);
            }
        }
    }
    return all;
}

std::string text_of(const MarginSummary& summary) {
    std::string text = fmt::format("{} '{}' of {}: ", summary.kind, summary.condition, summary.scenario);
    const std::string runs = fmt::format("of {} run{}", summary.count, summary.count == 1 ? "" : "s");
    const auto where = [](const LeastOfRuns& least) {
        return fmt::format(", at {} of {}", text_of_time(least.time), least.run);
    };
    std::string values;
    // If a deadline was met, the time left is more useful than the number that met it.
    const bool met = summary.earliest && summary.kind != "maintain";
    if (summary.least && (!met || summary.least->value < 0))
        values = fmt::format("least margin {} {}{}", runs, text_of_number(summary.least->value, summary.unit),
                             where(*summary.least));
    if (summary.earliest && (met || !summary.least))
        values += fmt::format("{}least time left {} {}{}", values.empty() ? "" : "; ", runs,
                              text_of_time(summary.earliest->value), where(*summary.earliest));
    if (values.empty()) return text + "no margin: " + summary.why;
    if (summary.without > 0) values += fmt::format(" ({} without a margin: {})", summary.without, summary.why);
    return text + values;
}

std::string margins_csv(const std::vector<MeasuredRun>& runs) {
    std::string out = std::string(margin_columns) + "\n";
    for (const MeasuredRun& run : runs) {
        for (const ConditionMargin& margin : run.margins) {
            const std::vector<std::string> fields{csv_field(run.scenario),
                                                  csv_field(run.name),
                                                  fmt::to_string(run.seed),
                                                  csv_field(margin.condition),
                                                  margin.kind,
                                                  cell(margin.margin),
                                                  csv_field(margin.unit),
                                                  fmt::to_string(margin.time),
                                                  cell(margin.left),
                                                  csv_field(margin.why)};
            out += csv_row(fields) + "\n";
        }
    }
    return out;
}

bool is_margins_csv(std::string_view text) { return text.starts_with(margin_columns); }

}  // namespace nezumi
