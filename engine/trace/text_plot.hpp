// Curves over time as text: in Braille's dots for a terminal, or with plain characters.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/trace/series.hpp"

namespace nezumi {

/// A curve of steps: a value holds until the next one.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points{};  ///< time [s], ascending, and value; not finite: left out
    char mark = '*';                                  ///< what a plain plot draws it with
};

struct PlotSize {
    std::size_t columns = 72;  ///< [characters] of the drawing, labels not counted
    std::size_t rows = 5;      ///< [lines]
};

/// The curves over each other, a later one over those before, with the range of values at the left and that of times
/// below; then what each is drawn with. Empty when there is nothing to draw.
std::vector<std::string> plain_plot(const std::vector<Curve>& curves, const PlotSize& size);

/// A drawing in Braille for every value of a series between two times [s], each with its least and its largest value;
/// of those that do not change one line.
std::string braille_plot(const Series& series, double from, double to, const PlotSize& size = {});

}  // namespace nezumi
