// Curves as text, in Braille's dots.
#pragma once

#include <cstddef>
#include <string>

#include "bindings/console/history.hpp"

namespace nezumi {

struct PlotSize {
    std::size_t columns = 72;  ///< [characters] of the drawing, labels not counted
    std::size_t rows = 5;      ///< [lines] of each curve
};

/// A drawing for every value of the port between two simulated times [s], each with its least and its largest value; of
/// those that do not change one line.
std::string plot_text(const Series& series, double from, double to, const PlotSize& size = {});

}  // namespace nezumi
