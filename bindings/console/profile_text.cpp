// The times of behaviours are CPU times of the executing thread; the times of native components are real times.
#include "bindings/console/profile_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

constexpr std::size_t most_rows = 20;

std::string text_of_time(double nanoseconds) {
    if (nanoseconds < 1e6) return fmt::format("{:.1f} us", nanoseconds * 1e-3);
    return fmt::format("{:.2f} ms", nanoseconds * 1e-6);
}

struct Cost {
    std::string name;
    std::size_t count;
    double median, worst, mean;
};

Cost cost_of(const std::string& name, std::vector<std::int64_t> times) {
    if (times.empty()) return {name, 0, 0, 0, 0};
    std::sort(times.begin(), times.end());
    const double sum = std::accumulate(times.begin(), times.end(), 0.0);
    return {name, times.size(), static_cast<double>(times[times.size() / 2]), static_cast<double>(times.back()),
            sum / static_cast<double>(times.size())};
}

std::string text_of_line(const std::string& text, int line) {
    std::string_view rest = text;
    for (int i = 1; i < line && !rest.empty(); ++i) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    return std::string(trimmed(rest.substr(0, rest.find('\n'))));
}

}  // namespace

std::string cost_table(const std::map<std::string, ExecutionProfile>& behaviors,
                       const std::map<std::string, TickCosts>& natives, double rate) {
    std::vector<Cost> costs;
    std::size_t widest = std::string_view("component").size();
    const auto add = [&](const auto& components) {
        for (const auto& [name, measured] : components) {
            costs.push_back(cost_of(name, measured.times));
            widest = std::max(widest, name.size());
        }
    };
    add(behaviors);
    add(natives);
    std::stable_sort(costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.mean > b.mean; });
    std::string text = fmt::format("{:{}}  executions      median       worst  mean/tick", "component", widest);
    for (const Cost& cost : costs) {
        text += fmt::format("\n{:{}}  {:10}  {:>10}  {:>10}  {:7.2f} %", cost.name, widest, cost.count,
                            text_of_time(cost.median), text_of_time(cost.worst), cost.mean * 1e-9 * rate * 100);
    }
    return text;
}

std::string line_table(const LineCosts& lines, const std::function<std::string(const std::string& file)>& text_of) {
    struct Row {
        double time = 0;
        std::int64_t count = 0;
    };
    std::map<std::pair<std::string, int>, Row> rows;
    double all = 0;
    for (const LineCosts::Node& node : lines.nodes()) {
        if (!node.is_line) continue;
        Row& row = rows[{node.file, node.line}];
        row.time += static_cast<double>(node.nanoseconds);
        row.count += node.count;
        all += static_cast<double>(node.nanoseconds);
    }
    if (rows.empty()) return "no line was executed";
    std::vector<std::pair<std::pair<std::string, int>, Row>> sorted(rows.begin(), rows.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second.time > b.second.time; });
    const std::size_t more = sorted.size() > most_rows ? sorted.size() - most_rows : 0;
    sorted.resize(sorted.size() - more);
    std::string text = "  share        time        count  line";
    for (const auto& [place, row] : sorted) {
        text += fmt::format("\n{:5.1f} %  {:>10}  {:>11}  {}:{}  {}", all > 0 ? 100 * row.time / all : 0,
                            text_of_time(row.time), row.count, place.first, place.second,
                            text_of_line(text_of(place.first), place.second));
    }
    if (more > 0) text += fmt::format("\nand {} more lines", more);
    return text;
}

}  // namespace nezumi
