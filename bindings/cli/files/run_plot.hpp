// Draws what differs between two runs, for `judge` and `compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/journal/field_curves.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// The curves of a run, and the run's name in the legend, such as "then".
struct NamedRun {
    std::string name;
    const FieldCurves& curves;
};

/// How two runs differ.
struct RunPlot {
    std::string title;
    std::vector<std::string> fields;  ///< the first four that have numbers are drawn
    NamedRun first, second;
    std::optional<double> differ_at;  ///< [s] first difference
};

/// Draws the runs to a file that ends in .png or .svg; prints a line instead if no field has numbers.
Expected<void> draw_runs(const RunPlot& runs, const std::string& file);

/// Fails if the value of --plot is not the name of a picture that can be written; "" (no plot) is valid.
Expected<void> check_plot(const std::string& file);

}  // namespace nezumi::cli
