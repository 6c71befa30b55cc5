// Plots of a sweep's measures over its parameters: medians, quartiles, and every run as a point.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::draw {

/// A measure of a scenario over one parameter, with the runs for all values of the other parameters. If there is a
/// second parameter, each of its values has a series.
struct SweepPlot {
    /// The runs with one value of the parameter, or with a range of values if there are many.
    struct Group {
        double at = 0;  ///< the value, the middle of the range, or the index of a value that is not a number
        std::string label;
        std::vector<double> sorted;               ///< measured values in ascending order; at least one
        double lower = 0, median = 0, upper = 0;  ///< their quartiles
    };
    struct Point {
        double at;
        double value;
    };
    struct Series {
        std::string label;          ///< the value of the second parameter; "" without one
        std::vector<Group> groups;  ///< in the order of `at`
        std::vector<Point> points{};
    };

    std::string title;
    std::string parameter;
    std::string by;       ///< the second parameter; "" without one
    std::string measure;  ///< with its unit
    bool is_numeric = true;
    std::vector<std::string> labels{};  ///< labels of positions 0, 1, ... if the values are not numbers
    std::vector<Series> series;         ///< at least one
    std::string file;                   ///< name without the folder
};

/// Draws the plot as SVG. The error says why the file can't be written; then there is no file.
Expected<void> draw_sweep_plot(const SweepPlot& plot, const std::filesystem::path& folder);

}  // namespace nezumi::draw
