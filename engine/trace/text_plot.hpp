// Curves over time as text: with Braille dots for a terminal, or with plain characters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/trace/series.hpp"

namespace nezumi {

/// A step curve: a value holds until the next one.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points{};  ///< time [s], ascending, and value; only finite
    char mark = '*';                                  ///< its character in a plain plot
    std::vector<std::string> texts{};                 ///< of a curve of texts: its values are indices in this list
};

/// The curves of a series between two times [s], one for each label within `part`. With `holds`, a curve starts with
/// the last value before the start, and its last value continues to the end.
std::vector<Curve> curves_of(const Series& series, std::string_view part, double from, double to, bool holds = false);

/// `mode: "slow" from 1.5 s, "fast" from 2 s`: a curve of texts; only the last changes if there are many.
std::string text_line(const Curve& curve);

struct PlotSize {
    std::size_t columns = 72;  ///< [characters] of the drawing without labels
    std::size_t rows = 5;      ///< [lines]
};

/// Draws the curves in one drawing, later ones over earlier ones, with the range of values at the left and the range of
/// times below; then a legend of the characters. Empty if there is nothing to draw.
std::vector<std::string> plain_plot(const std::vector<Curve>& curves, const PlotSize& size);

/// Draws each curve between two times [s] with Braille dots, with its least and its largest value. A constant curve and
/// a curve of texts are one line each.
std::string braille_plot(const std::vector<Curve>& curves, double from, double to, const PlotSize& size = {});

}  // namespace nezumi
