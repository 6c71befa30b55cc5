// Curves over time as text: in Braille's dots for a terminal, or with plain characters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/trace/series.hpp"

namespace nezumi {

/// A curve of steps: a value holds until the next one.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points{};  ///< time [s], ascending, and value; not finite: left out
    char mark = '*';                                  ///< what a plain plot draws it with
    std::vector<std::string> texts{};                 ///< of texts: the values are places in it
};

/// The values of a series under the labels within `part`, between two times [s], by their labels. `holds`: what was
/// before counts at the beginning, and the last value until the end.
std::vector<Curve> curves_of(const Series& series, std::string_view part, double from, double to, bool holds = false);

/// "mode: slow from 1.5 s, fast from 2 s": a curve of texts, the last changes when there are many.
std::string text_line(const Curve& curve);

struct PlotSize {
    std::size_t columns = 72;  ///< [characters] of the drawing, labels not counted
    std::size_t rows = 5;      ///< [lines]
};

/// The curves over each other, a later one over those before, with the range of values at the left and that of times
/// below; then what each is drawn with. Empty when there is nothing to draw.
std::vector<std::string> plain_plot(const std::vector<Curve>& curves, const PlotSize& size);

/// A drawing in Braille for each curve between two times [s], with its least and its largest value; of those that do
/// not change, and of texts, one line.
std::string braille_plot(const std::vector<Curve>& curves, double from, double to, const PlotSize& size = {});

}  // namespace nezumi
