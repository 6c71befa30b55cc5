// Makes plots of measures over the swept parameters from a session's runs.
#pragma once

#include <vector>

#include "bindings/draw/sweep_plot.hpp"
#include "bindings/scenario/measures.hpp"

namespace nezumi::cli {

/// One plot for each scenario, measure and parameter with more than one value, from valid runs.
std::vector<draw::SweepPlot> sweep_plots(const std::vector<MeasuredRun>& runs);

}  // namespace nezumi::cli
