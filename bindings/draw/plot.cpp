// A value holds until the next one, so series are drawn as steps.
#include "bindings/draw/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/draw/axis.hpp"
#include "bindings/draw/canvas.hpp"

namespace nezumi::draw {
namespace {

class PlotPainter {
public:
    PlotPainter(const Plot& plot, const std::string& file)
        : plot_(plot), legend_(rows_of_legend() * row), canvas_(file, width, height + legend_) {
        for (const Plot::Series& series : plot.series) {
            for (const Plot::Point& point : series.points) {
                times_.include(point.seconds);
                values_.include(point.value);
            }
        }
        for (const Plot::Limit& limit : plot.limits) values_.include(limit.value);
        for (const Plot::Moment& moment : plot.moments) times_.include(moment.seconds);
        times_.widen(0, 0.5);
        values_.widen(0.06, 0.5);
    }

    Expected<void> paint() {
        canvas_.text(left, 34, plot_.title, 18, ink::text, 0, true);
        axes();
        cairo_save(context());
        cairo_rectangle(context(), left, head, width - left - right, height - head - axis);
        cairo_clip(context());
        for (std::size_t i = 0; i < plot_.series.size(); ++i) draw(plot_.series[i], series_colour(i));
        for (const Plot::Limit& limit : plot_.limits) draw(limit);
        for (const Plot::Moment& moment : plot_.moments) draw(moment);
        cairo_restore(context());
        legend();
        return canvas_.write();
    }

private:
    static constexpr double width = 960, height = 440;  // [px]
    static constexpr double left = 76, right = 28, head = 56, axis = 44,
                            row = 22;              // [px] margins; `row` is a row of the legend
    static constexpr std::size_t most_named = 24;  // largest number of series in the legend

    static constexpr double columns = 3;

    cairo_t* context() { return canvas_.context(); }
    double x(double seconds) const {
        return left + (seconds - times_.low) / (times_.high - times_.low) * (width - left - right);
    }
    double y(double value) const {
        return height - axis - (value - values_.low) / (values_.high - values_.low) * (height - head - axis);
    }
    std::size_t named() const { return std::min(plot_.series.size(), most_named); }
    double rows_of_legend() const { return std::ceil(static_cast<double>(named()) / columns) + 1; }

    void line(double x1, double y1, double x2, double y2) {
        cairo_move_to(context(), x1, y1);
        cairo_line_to(context(), x2, y2);
        cairo_stroke(context());
    }

    void axes() {
        cairo_set_line_width(context(), 1);
        const double down = round_step(values_, 6), across = round_step(times_, 10);
        for (double at = std::ceil(values_.low / down) * down; at <= values_.high; at += down) {
            canvas_.set(colour_of("#e4e2dd"));
            line(left, std::round(y(at)) + 0.5, width - right, std::round(y(at)) + 0.5);
            const double shown = std::abs(at) < down * 1e-6 ? 0 : at;
            canvas_.text(left - 8, y(at) + 4, fmt::format("{:.6g}", shown), 12, ink::faint, 1);
        }
        for (double at = std::ceil(times_.low / across) * across; at <= times_.high + across * 1e-6; at += across) {
            canvas_.set(colour_of("#e4e2dd"));
            line(std::round(x(at)) + 0.5, head, std::round(x(at)) + 0.5, height - axis);
            const double shown = std::abs(at) < across * 1e-6 ? 0 : at;
            canvas_.text(x(at), height - axis + 18, fmt::format("{:.6g}", shown), 12, ink::faint, 0.5);
        }
        canvas_.text(width - right, height - axis + 36, "simulated time [s]", 12, ink::faint, 1);
        canvas_.set(colour_of("#b9b5ad"));
        cairo_rectangle(context(), left + 0.5, head + 0.5, width - left - right - 1, height - head - axis - 1);
        cairo_stroke(context());
    }

    void draw(const Plot::Series& series, const Colour& colour) {
        canvas_.set(colour);
        cairo_set_line_width(context(), 1.8);
        bool drawing = false;
        double before = 0;
        for (const Plot::Point& point : series.points) {
            if (std::exchange(drawing, std::isfinite(point.value)) && drawing) {
                cairo_line_to(context(), x(point.seconds), y(before));
                cairo_line_to(context(), x(point.seconds), y(point.value));
            } else if (drawing) {
                cairo_move_to(context(), x(point.seconds), y(point.value));
            }
            before = point.value;
        }
        cairo_stroke(context());
    }

    void dashed(const Colour& colour) {
        const double dashes[] = {6, 5};
        canvas_.set(colour);
        cairo_set_line_width(context(), 1.5);
        cairo_set_dash(context(), dashes, 2, 0);
    }

    void draw(const Plot::Limit& limit) {
        const Colour colour = colour_of("#c1272d");
        dashed(colour);
        line(left, y(limit.value), width - right, y(limit.value));
        cairo_set_dash(context(), nullptr, 0, 0);
        const double above = y(limit.value) - 5 > head + 12 ? -5 : 15;
        canvas_.text(width - right - 8, y(limit.value) + above, limit.name, 12, colour, 1);
    }

    void draw(const Plot::Moment& moment) {
        const Colour colour = colour_of("#5b3a8c");
        dashed(colour);
        line(x(moment.seconds), head, x(moment.seconds), height - axis);
        cairo_set_dash(context(), nullptr, 0, 0);
        const bool at_right = x(moment.seconds) > width / 2;
        canvas_.text(x(moment.seconds) + (at_right ? -6 : 6), head + 16, moment.name, 12, colour, at_right ? 1 : 0);
    }

    void legend() {
        const double column = (width - left - right) / columns;
        for (std::size_t i = 0; i < named(); ++i) {
            const double at_x = left + column * std::fmod(static_cast<double>(i), columns);
            const double at_y = height + row * std::floor(static_cast<double>(i) / columns) + 10;
            canvas_.set(series_colour(i));
            cairo_set_line_width(context(), 3);
            line(at_x, at_y - 4, at_x + 18, at_y - 4);
            canvas_.text(at_x + 26, at_y, plot_.series[i].name, 13, ink::text);
        }
    }

    const Plot& plot_;
    double legend_;  // [px] height of the legend
    Canvas canvas_;
    AxisRange times_, values_;
};

}  // namespace

Expected<void> draw_plot(const Plot& plot, const std::string& file) { return PlotPainter(plot, file).paint(); }

}  // namespace nezumi::draw
