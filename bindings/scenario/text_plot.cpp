// Columns are times, rows are values.
#include "bindings/scenario/text_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nezumi {
namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return low > high; }
    std::size_t place(double value, std::size_t places) const {
        if (high == low || places < 2) return 0;
        const double share = (value - low) / (high - low);
        return static_cast<std::size_t>(std::lround(share * static_cast<double>(places - 1)));
    }
};

}  // namespace

std::vector<std::string> plot_text(const std::vector<PlotCurve>& curves, std::size_t width, std::size_t height) {
    Range times;
    Range values;
    for (const PlotCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.times.size(); ++i) {
            if (!std::isfinite(curve.values[i])) continue;
            times.add(curve.times[i]);
            values.add(curve.values[i]);
        }
    }
    if (times.empty()) return {};
    if (values.low == values.high) {
        values.low -= 1;
        values.high += 1;
    }
    const std::string top = fmt::format("{:.4g}", values.high);
    const std::string bottom = fmt::format("{:.4g}", values.low);
    const std::size_t margin = std::max(top.size(), bottom.size());
    const std::size_t columns = width > margin + 10 ? width - margin - 2 : 8;
    std::vector<std::string> rows(height, std::string(columns, ' '));
    for (const PlotCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.times.size(); ++i) {
            if (!std::isfinite(curve.values[i])) continue;
            const std::size_t row = height - 1 - values.place(curve.values[i], height);
            rows[row][times.place(curve.times[i], columns)] = curve.mark;
        }
    }
    std::vector<std::string> lines;
    for (std::size_t row = 0; row < height; ++row) {
        const std::string& label = row == 0 ? top : row + 1 == height ? bottom : std::string();
        std::string line = fmt::format("{:>{}} |{}", label, margin, rows[row]);
        line.erase(line.find_last_not_of(' ') + 1);
        lines.push_back(std::move(line));
    }
    const std::string from = fmt::format("{:.4g} s", times.low);
    const std::string to = fmt::format("{:.4g} s", times.high);
    const std::size_t gap = columns > from.size() + to.size() ? columns - from.size() - to.size() : 1;
    lines.push_back(std::string(margin + 2, ' ') + from + std::string(gap, ' ') + to);
    std::string legend(margin + 2, ' ');
    for (const PlotCurve& curve : curves) legend += fmt::format("{} {}   ", curve.mark, curve.name);
    legend.erase(legend.find_last_not_of(' ') + 1);
    lines.push_back(std::move(legend));
    return lines;
}

}  // namespace nezumi
