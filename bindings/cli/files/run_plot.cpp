// Each field has two curves, one for each run, with the same scale and next to each other in the legend.
#include "bindings/cli/files/run_plot.hpp"

#include <fmt/format.h>

#include "bindings/cli/files/output_files.hpp"
#include "bindings/draw/plot.hpp"

namespace nezumi::cli {

Expected<void> draw_runs(const RunPlot& runs, const std::string& file) {
    constexpr std::size_t most_fields = 4;
    draw::Plot plot{.title = runs.title, .series = {}, .limits = {}, .moments = {}};
    for (const std::string& field : runs.fields) {
        if (plot.series.size() == 2 * most_fields) break;
        if (runs.first.curves.of(field).empty() && runs.second.curves.of(field).empty()) continue;
        for (const NamedRun* run : {&runs.first, &runs.second}) {
            draw::Plot::Series& series = plot.series.emplace_back();
            series.name = fmt::format("{} {}", field, run->name);
            for (const auto& [seconds, value] : run->curves.of(field)) series.points.push_back({seconds, value});
        }
    }
    if (plot.series.empty()) {
        fmt::print("no plot: there are no numbers to draw\n");
        return {};
    }
    if (runs.differ_at) plot.moments.push_back({"first difference", *runs.differ_at});
    return draw::draw_plot(plot, file);
}

Expected<void> check_plot(const std::string& file) {
    if (file.empty()) return {};
    if (!is_picture_name(file))
        return failure(fmt::format("--plot: expected a file name that ends in .png or .svg, got '{}'", shown(file)));
    return check_can_write(file);
}

}  // namespace nezumi::cli
