// Markers on paper: a page for each, to scale.
#pragma once

#include <cairo.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

struct Paper {
    std::string_view name;
    double width;   ///< [m]
    double height;  ///< [m]
};

/// A5, A4, A3 (ISO 216) and letter (ANSI/ASME Y14.1).
const std::vector<Paper>& papers();

/// [m] The largest black border whose marker fits on the paper with its white margin and the lines below it.
double largest_marker(const Paper& paper);

/// Draws the marker `id` in the middle of the sheet, with its number, its size and a line to measure by below it. The
/// context's unit is 1 m from the top left; `size` [m] is the edge of the black border, at most `largest_marker`.
void draw_marker(cairo_t* context, const Paper& paper, int id, double size);

/// A PDF with a page for each marker.
Expected<std::string> marker_pdf(const Paper& paper, const std::vector<int>& ids, double size);

}  // namespace nezumi::cli
