// Measures over the parameters of a sweep, drawn to files: medians, quartiles, and every run as a point.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::draw {

/// A measure of a scenario over one parameter, whatever the others were.
struct SweepPlot {
    /// The runs with one value of the parameter, or with one of a range where there are many values.
    struct Group {
        double at = 0;  ///< the value, the middle of the range, or the place among values that are no numbers
        std::string label;
        std::vector<double> sorted;               ///< what was measured, in ascending order; at least one
        double lower = 0, median = 0, upper = 0;  ///< quartiles of it
    };
    struct Point {
        double at;
        double value;
    };

    std::string title;
    std::string parameter;
    std::string measure;  ///< with its unit
    bool is_numeric = true;
    std::vector<Group> groups;  ///< in the order of `at`
    std::vector<Point> points;
    std::string file;  ///< its name, without the folder
};

/// Draws one as SVG. An error says why it can't be written; then there is no file.
Expected<void> draw_sweep_plot(const SweepPlot& plot, const std::filesystem::path& folder);

}  // namespace nezumi::draw
