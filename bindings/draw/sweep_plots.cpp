// Numbers lie where they are on the axis, other values side by side.
#include "bindings/draw/sweep_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <tuple>

#include "bindings/draw/axis.hpp"
#include "bindings/draw/canvas.hpp"
#include "bindings/scenario/failure_folder.hpp"

namespace nezumi::draw {
namespace {

constexpr std::size_t most_groups = 20;  // more values than these are put together
constexpr std::size_t ranges = 10;       // in so many ranges

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
    for (SweepPlot::Group& group : plot.groups) std::sort(group.sorted.begin(), group.sorted.end());
}

// A group for each value; for each of `ranges` equal ranges where there are too many.
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

// Side by side, in the order in which they come first.
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

class SweepPainter {
public:
    SweepPainter(const SweepPlot& plot, const std::string& file) : plot_(plot), canvas_(file, width, height) {
        for (const SweepPlot::Point& point : plot.points) {
            across_.include(point.at);
            up_.include(point.value);
        }
        if (plot.is_numeric) {
            across_.widen(0.05, 0.5);
        } else {
            across_.low -= 0.6;
            across_.high += 0.6;
        }
        up_.widen(0.08, 0.5);
    }

    Expected<void> paint() {
        canvas_.text(left, 34, plot_.title, 18, ink::text, 0, true);
        axes();
        points();
        if (plot_.is_numeric) {
            band();
        } else {
            boxes();
        }
        return canvas_.write();
    }

private:
    static constexpr double width = 720, height = 460;                    // [px]
    static constexpr double left = 84, right = 28, head = 56, axis = 64;  // [px] around the drawing

    cairo_t* context() { return canvas_.context(); }
    double x(double at) const {
        return left + (at - across_.low) / (across_.high - across_.low) * (width - left - right);
    }
    double y(double value) const {
        return height - axis - (value - up_.low) / (up_.high - up_.low) * (height - head - axis);
    }

    void line(double x1, double y1, double x2, double y2) {
        cairo_move_to(context(), x1, y1);
        cairo_line_to(context(), x2, y2);
        cairo_stroke(context());
    }

    void axes() {
        const Colour grid = colour_of("#e4e2dd");
        cairo_set_line_width(context(), 1);
        const double step = round_step(up_, 6);
        for (double at = std::ceil(up_.low / step) * step; at <= up_.high; at += step) {
            canvas_.set(grid);
            line(left, std::round(y(at)) + 0.5, width - right, std::round(y(at)) + 0.5);
            canvas_.text(left - 8, y(at) + 4, fmt::format("{:.6g}", std::abs(at) < step * 1e-6 ? 0 : at), 12,
                         ink::faint, 1);
        }
        if (plot_.is_numeric) {
            const double along = round_step(across_, 8);
            for (double at = std::ceil(across_.low / along) * along; at <= across_.high; at += along)
                mark(at, fmt::format("{:.6g}", std::abs(at) < along * 1e-6 ? 0 : at));
        } else {
            for (const SweepPlot::Group& group : plot_.groups) mark(group.at, group.label);
        }
        canvas_.text(width - right, height - axis + 42, plot_.parameter, 13, ink::text, 1);
        canvas_.text(left, head - 6, plot_.measure, 13, ink::text);
        canvas_.set(colour_of("#b9b5ad"));
        cairo_rectangle(context(), left + 0.5, head + 0.5, width - left - right - 1, height - head - axis - 1);
        cairo_stroke(context());
    }

    void mark(double at, const std::string& label) {
        canvas_.set(colour_of("#e4e2dd"));
        line(std::round(x(at)) + 0.5, head, std::round(x(at)) + 0.5, height - axis);
        canvas_.text(x(at), height - axis + 18, label, 12, ink::faint, 0.5);
    }

    void points() {
        canvas_.set(series_colour(0).with_alpha(0.3));
        for (const SweepPlot::Point& point : plot_.points) {
            cairo_arc(context(), x(point.at), y(point.value), 2.5, 0, 2 * M_PI);
            cairo_fill(context());
        }
    }

    // From quartile to quartile, with a line through the medians.
    void band() {
        const auto& groups = plot_.groups;
        for (const auto& group : groups) cairo_line_to(context(), x(group.at), y(quantile(group.sorted, 0.25)));
        for (auto group = groups.rbegin(); group != groups.rend(); ++group)
            cairo_line_to(context(), x(group->at), y(quantile(group->sorted, 0.75)));
        cairo_close_path(context());
        canvas_.set(series_colour(0).with_alpha(0.2));
        cairo_fill(context());
        canvas_.set(series_colour(0));
        cairo_set_line_width(context(), 2);
        for (const auto& group : groups) cairo_line_to(context(), x(group.at), y(quantile(group.sorted, 0.5)));
        cairo_stroke(context());
        for (const auto& group : groups) {
            cairo_arc(context(), x(group.at), y(quantile(group.sorted, 0.5)), 4, 0, 2 * M_PI);
            cairo_fill(context());
        }
    }

    void boxes() {
        const double half = std::min(30.0, (x(1) - x(0)) * 0.3);
        for (const auto& group : plot_.groups) {
            const double low = y(quantile(group.sorted, 0.25)), high = y(quantile(group.sorted, 0.75));
            cairo_rectangle(context(), x(group.at) - half, high, 2 * half, low - high);
            canvas_.set(series_colour(0).with_alpha(0.2));
            cairo_fill(context());
            canvas_.set(series_colour(0));
            cairo_set_line_width(context(), 3);
            const double median = y(quantile(group.sorted, 0.5));
            line(x(group.at) - half, median, x(group.at) + half, median);
        }
    }

    const SweepPlot& plot_;
    Canvas canvas_;
    AxisRange across_, up_;
};

}  // namespace

std::vector<SweepPlot> sweep_plots(const std::vector<MeasuredRun>& runs) {
    // By scenario, measure, unit and parameter, in the order in which they come first.
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

Expected<void> draw_sweep_plot(const SweepPlot& plot, const std::filesystem::path& folder) {
    return SweepPainter(plot, (folder / plot.file).string()).paint();
}

}  // namespace nezumi::draw
