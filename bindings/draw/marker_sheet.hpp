// Markers for printing: one page each, to scale.
#pragma once

#include <string>
#include <vector>

#include "bindings/draw/paper.hpp"
#include "engine/base/error.hpp"

namespace nezumi::draw {

/// Returns a PDF with a page for each tag. `size` [m] is the edge of the black border, at most `largest_marker`.
Expected<std::string> marker_pdf(const Paper& paper, const std::vector<PrintedTag>& tags, double size);

}  // namespace nezumi::draw
