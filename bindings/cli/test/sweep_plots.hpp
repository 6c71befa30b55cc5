// From the runs of a session to the plots of what they measured over what was swept.
#pragma once

#include <vector>

#include "bindings/draw/sweep_plot.hpp"
#include "bindings/scenario/measures.hpp"

namespace nezumi::cli {

/// One for each scenario, measure and parameter that has more than one value, of the runs that count.
std::vector<draw::SweepPlot> sweep_plots(const std::vector<MeasuredRun>& runs);

}  // namespace nezumi::cli
