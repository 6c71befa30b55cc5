// One grid of dots for both styles: a plain character is one dot, a Braille character two by four.
#include "engine/trace/text_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/visible.hpp"
#include "engine/trace/channel.hpp"

namespace nezumi {
namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    std::size_t place(double value, std::size_t places) const {
        const double share = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
        return static_cast<std::size_t>(std::lround(share * static_cast<double>(places - 1)));
    }
};

// The marks of dots, row by row from the top; 0: none.
struct Dots {
    std::size_t width, height;
    std::vector<char> marks = std::vector<char>(width * height, 0);

    char& at(std::size_t x, std::size_t y) { return marks[y * width + x]; }

    void draw(const Curve& curve, const Range& times, const Range& values) {
        bool first = true;
        std::size_t last_x = 0, last_y = 0;
        for (const auto& [seconds, value] : curve.points) {
            if (!std::isfinite(value)) continue;
            const std::size_t x = times.place(seconds, width), y = height - 1 - values.place(value, height);
            if (std::exchange(first, false)) last_x = x, last_y = y;
            for (std::size_t i = last_x; i < x; ++i) at(i, last_y) = curve.mark;
            for (std::size_t i = std::min(y, last_y); i <= std::max(y, last_y); ++i) at(x, i) = curve.mark;
            last_x = x;
            last_y = y;
        }
    }
    std::string plain_row(std::size_t row) {
        std::string text(&at(0, row), width);
        std::replace(text.begin(), text.end(), '\0', ' ');
        return text;
    }
    std::string braille_row(std::size_t row) {
        // Unicode's bits for the dots of a Braille character, from the top left: U+2800 plus the sum.
        constexpr unsigned bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
        std::string text;
        for (std::size_t column = 0; column < width / 2; ++column) {
            unsigned cell = 0;
            for (std::size_t i = 0; i < 8; ++i)
                cell += at(column * 2 + i % 2, row * 4 + i / 2) != 0 ? bits[i / 2][i % 2] : 0;
            text += '\xE2';
            text += static_cast<char>(0xA0 | (cell >> 6));
            text += static_cast<char>(0x80 | (cell & 0x3F));
        }
        return text;
    }
};

std::string number_text(double value) { return fmt::format("{:.4g}", value == 0 ? 0.0 : value); }

enum class Ink { plain, braille };

// Draws the rows with their labels, and the time axis.
std::vector<std::string> draw(const std::vector<Curve>& curves, const Range& times, const Range& values,
                              const PlotSize& size, Ink ink) {
    const bool braille = ink == Ink::braille;
    Dots dots{size.columns * (braille ? 2 : 1), size.rows * (braille ? 4 : 1)};
    for (const Curve& curve : curves) dots.draw(curve, times, values);
    const std::string top = number_text(values.high), bottom = number_text(values.low);
    const std::size_t width = std::max(top.size(), bottom.size());
    std::vector<std::string> lines;
    for (std::size_t row = 0; row < size.rows; ++row) {
        const std::string& label = row == 0 ? top : row + 1 == size.rows ? bottom : std::string();
        lines.push_back(fmt::format("{:>{}} {}", label, width, braille ? "│" : "|") +
                        (braille ? dots.braille_row(row) : dots.plain_row(row)));
        lines.back().erase(lines.back().find_last_not_of(' ') + 1);
    }
    const std::string left = fmt::format("{:.6g} s", times.low), right = fmt::format("{:.6g} s", times.high);
    const std::size_t gap = size.columns > left.size() + right.size() ? size.columns - left.size() - right.size() : 1;
    lines.push_back(std::string(width + 2, ' ') + left + std::string(gap, ' ') + right);
    return lines;
}

}  // namespace

std::vector<std::string> plain_plot(const std::vector<Curve>& curves, const PlotSize& size) {
    Range times, values;
    for (const Curve& curve : curves) {
        for (const auto& [seconds, value] : curve.points) {
            if (!std::isfinite(value)) continue;
            times.add(seconds);
            values.add(value);
        }
    }
    if (times.low > times.high) return {};
    if (values.low == values.high) values = {values.low - 1, values.high + 1};
    std::vector<std::string> lines = draw(curves, times, values, size, Ink::plain);
    std::string legend(lines.back().find_first_not_of(' '), ' ');
    for (const Curve& curve : curves) legend += fmt::format("{} {}   ", curve.mark, curve.name);
    legend.erase(legend.find_last_not_of(' ') + 1);
    lines.push_back(std::move(legend));
    return lines;
}

std::vector<Curve> curves_of(const Series& series, std::string_view part, double from, double to, bool holds) {
    std::vector<Curve> curves;
    for (std::size_t label = 0; label < series.labels().size(); ++label) {
        const std::string& name = series.labels()[label];
        if (!is_within(name, part)) continue;
        Curve curve{name.empty() ? "value" : name};
        if (series.is_text(label)) curve.texts = series.texts();
        for (std::size_t i = 0; i < series.size(); ++i) {
            const double value = series.value(i, label), at = series.seconds(i);
            if (at > to || !std::isfinite(value)) continue;
            if (at < from && !holds) continue;
            if (at < from) curve.points.clear();
            curve.points.emplace_back(std::max(at, from), value);
        }
        if (curve.points.empty()) continue;
        if (holds && curve.points.back().first < to) curve.points.emplace_back(to, curve.points.back().second);
        curves.push_back(std::move(curve));
    }
    return curves;
}

std::string text_line(const Curve& curve) {
    constexpr std::size_t most_shown = 8;
    std::vector<std::string> changes;
    double last = -1;
    for (const auto& [seconds, place] : curve.points) {
        if (std::exchange(last, place) == place) continue;
        const auto index = static_cast<std::size_t>(place);
        changes.push_back(fmt::format("\"{}\" from {:.6g} s", visible(curve.texts[index]), seconds));
    }
    std::string text = curve.name + ": ";
    if (changes.size() > most_shown) {
        text += "..., ";
        changes.erase(changes.begin(), changes.end() - most_shown);
    }
    return text + fmt::format("{}", fmt::join(changes, ", "));
}

std::string braille_plot(const std::vector<Curve>& curves, double from, double to, const PlotSize& size) {
    std::string text;
    const auto add = [&text](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
    for (const Curve& curve : curves) {
        if (!curve.texts.empty()) {
            add(text_line(curve));
            continue;
        }
        Range values;
        for (const auto& [seconds, value] : curve.points) values.add(value);
        if (curve.points.size() == 1) {
            add(fmt::format("{} = {} at {:.6g} s, the only value that is remembered", curve.name,
                            number_text(values.low), curve.points.front().first));
        } else if (values.low == values.high || from >= to) {
            add(fmt::format("{} = {} all the time", curve.name, number_text(values.low)));
        } else {
            add(curve.name);
            for (const std::string& line : draw({curve}, {from, to}, values, size, Ink::braille)) add(line);
        }
    }
    return text;
}

}  // namespace nezumi
