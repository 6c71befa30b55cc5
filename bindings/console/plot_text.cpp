// A grid of dots, two by four to a character.
#include "bindings/console/plot_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nezumi {
namespace {

class Dots {
public:
    Dots(std::size_t columns, std::size_t rows)
        : width(columns * 2), height(rows * 4), columns_(columns), cells_(columns * rows, 0) {}

    void set(std::size_t x, std::size_t y) {
        // Unicode's numbers of the dots of a cell, from the top left: U+2800 plus the sum.
        constexpr unsigned char bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
        unsigned char& cell = cells_[y / 4 * columns_ + x / 2];
        cell = static_cast<unsigned char>(cell | bits[y % 4][x % 2]);
    }
    std::string row(std::size_t number) const {
        std::string text;
        for (std::size_t i = 0; i < columns_; ++i) {
            const unsigned char cell = cells_[number * columns_ + i];
            text += '\xE2';
            text += static_cast<char>(0xA0 | (cell >> 6));
            text += static_cast<char>(0x80 | (cell & 0x3F));
        }
        return text;
    }

    const std::size_t width;
    const std::size_t height;

private:
    std::size_t columns_;
    std::vector<unsigned char> cells_;
};

struct Curve {
    std::string label;
    std::vector<std::pair<double, double>> points;
    double least = 0;
    double largest = 0;
};

Curve curve_of(const Series& series, std::size_t number, double from, double to) {
    Curve curve;
    curve.label = series.labels[number].empty() ? "value" : series.labels[number];
    for (const Series::Sample& sample : series.samples) {
        if (sample.seconds < from || sample.seconds > to || number >= sample.values.size()) continue;
        const double value = sample.values[number];
        if (!std::isfinite(value)) continue;
        curve.least = curve.points.empty() ? value : std::min(curve.least, value);
        curve.largest = curve.points.empty() ? value : std::max(curve.largest, value);
        curve.points.emplace_back(sample.seconds, value);
    }
    return curve;
}

std::string number_text(double value) { return fmt::format("{:.4g}", value == 0 ? 0.0 : value); }

std::string draw(const Curve& curve, double from, double to, const PlotSize& size) {
    Dots dots(size.columns, size.rows);
    const auto place = [](double share, std::size_t count) {
        return static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * static_cast<double>(count - 1)));
    };
    std::size_t last_y = 0;
    std::size_t last_x = 0;
    bool first = true;
    for (const auto& [seconds, value] : curve.points) {
        const std::size_t x = place((seconds - from) / (to - from), dots.width);
        const std::size_t y =
            dots.height - 1 - place((value - curve.least) / (curve.largest - curve.least), dots.height);
        if (first) last_x = x, last_y = y, first = false;
        for (std::size_t i = last_x; i < x; ++i) dots.set(i, last_y);  // a value holds until the next
        for (std::size_t i = std::min(y, last_y); i <= std::max(y, last_y); ++i) dots.set(x, i);
        last_x = x;
        last_y = y;
    }
    const std::string top = number_text(curve.largest);
    const std::string bottom = number_text(curve.least);
    const std::size_t width = std::max(top.size(), bottom.size());
    std::string text = curve.label;
    for (std::size_t row = 0; row < size.rows; ++row) {
        const std::string& label = row == 0 ? top : row + 1 == size.rows ? bottom : std::string();
        text += fmt::format("\n{:>{}} │{}", label, width, dots.row(row));
    }
    const std::string left = fmt::format("{:.6g} s", from);
    const std::string right = fmt::format("{:.6g} s", to);
    const std::size_t gap = size.columns > left.size() + right.size() ? size.columns - left.size() - right.size() : 1;
    return text + fmt::format("\n{:{}}  {}{:{}}{}", "", width, left, "", gap, right);
}

}  // namespace

std::string plot_text(const Series& series, double from, double to, const PlotSize& size) {
    std::string text;
    const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "\n") + part; };
    for (std::size_t number = 0; number < series.labels.size(); ++number) {
        const Curve curve = curve_of(series, number, from, to);
        if (curve.points.empty()) continue;
        if (curve.least == curve.largest || from >= to) {
            add(fmt::format("{} = {} all the time", curve.label, number_text(curve.least)));
        } else {
            add(draw(curve, from, to, size));
        }
    }
    return text;
}

}  // namespace nezumi
