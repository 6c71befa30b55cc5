// Parameter values that are numbers have their position on the axis; other values are side by side.
#include "bindings/draw/sweep_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/draw/axis.hpp"
#include "bindings/draw/canvas.hpp"

namespace nezumi::draw {
namespace {

class SweepPainter {
public:
    SweepPainter(const SweepPlot& plot, const std::string& file) : plot_(plot), canvas_(file, width, height) {
        for (const SweepPlot::Series& series : plot.series) {
            for (const SweepPlot::Point& point : series.points) {
                across_.include(point.at);
                up_.include(point.value);
            }
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
        if (!plot_.by.empty()) legend();
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            points(i);
            if (plot_.is_numeric) {
                band(i);
            } else {
                boxes(i);
            }
        }
        return canvas_.write();
    }

private:
    static constexpr double width = 720, height = 460;                    // [px]
    static constexpr double left = 84, right = 28, head = 56, axis = 64;  // [px] margins around the drawing

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
            for (std::size_t i = 0; i < plot_.labels.size(); ++i) mark(static_cast<double>(i), plot_.labels[i]);
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

    // Writes the values of the second parameter in the colours of their series, from right to left.
    void legend() {
        constexpr double letter = 7.2;  // [px]
        double at = width - right;
        for (std::size_t i = plot_.series.size(); i-- > 0;) {
            const std::string& label = plot_.series[i].label;
            canvas_.text(at, head - 6, label, 13, series_colour(i), 1, true);
            at -= letter * static_cast<double>(label.size()) + 14;
        }
        canvas_.text(at, head - 6, plot_.by + ":", 13, ink::text, 1);
    }

    // The x position [px] of a value of a series. If values are not numbers, the series are side by side.
    double place(double at, std::size_t series) const {
        if (plot_.is_numeric) return x(at);
        const double middle = static_cast<double>(plot_.series.size() - 1) / 2;
        return x(at) + (static_cast<double>(series) - middle) * 2.4 * half_box();
    }
    double half_box() const { return std::min(30.0, (x(1) - x(0)) * 0.3) / static_cast<double>(plot_.series.size()); }

    void points(std::size_t series) {
        canvas_.set(series_colour(series).with_alpha(0.3));
        for (const SweepPlot::Point& point : plot_.series[series].points) {
            cairo_arc(context(), place(point.at, series), y(point.value), 2.5, 0, 2 * M_PI);
            cairo_fill(context());
        }
    }

    // Draws the area between the quartiles, and a line through the medians.
    void band(std::size_t series) {
        const auto& groups = plot_.series[series].groups;
        for (const auto& group : groups) cairo_line_to(context(), x(group.at), y(group.lower));
        for (auto group = groups.rbegin(); group != groups.rend(); ++group)
            cairo_line_to(context(), x(group->at), y(group->upper));
        cairo_close_path(context());
        canvas_.set(series_colour(series).with_alpha(0.2));
        cairo_fill(context());
        canvas_.set(series_colour(series));
        cairo_set_line_width(context(), 2);
        for (const auto& group : groups) cairo_line_to(context(), x(group.at), y(group.median));
        cairo_stroke(context());
        for (const auto& group : groups) {
            cairo_arc(context(), x(group.at), y(group.median), 4, 0, 2 * M_PI);
            cairo_fill(context());
        }
    }

    void boxes(std::size_t series) {
        const double half = half_box();
        for (const auto& group : plot_.series[series].groups) {
            const double low = y(group.lower), high = y(group.upper), at = place(group.at, series);
            cairo_rectangle(context(), at - half, high, 2 * half, low - high);
            canvas_.set(series_colour(series).with_alpha(0.2));
            cairo_fill(context());
            canvas_.set(series_colour(series));
            cairo_set_line_width(context(), 3);
            const double median = y(group.median);
            line(at - half, median, at + half, median);
        }
    }

    const SweepPlot& plot_;
    Canvas canvas_;
    AxisRange across_, up_;
};

}  // namespace

Expected<void> draw_sweep_plot(const SweepPlot& plot, const std::filesystem::path& folder) {
    return SweepPainter(plot, (folder / plot.file).string()).paint();
}

}  // namespace nezumi::draw
