// Flame graphs: a box for each function shows how long it took, above the function that called it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nezumi::draw {

/// A box of a flame graph.
struct FlameBox {
    std::size_t parent = 0;  ///< index of an earlier box; the first box is the root, its own parent
    std::string name{};
    double own = 0;  ///< [s] without its children
};

/// Draws the boxes as SVG. A box shows its time when the mouse pointer is on it.
std::string flame_svg(const std::vector<FlameBox>& boxes, const std::string& title);

/// Writes the boxes as JSON of trace events, for speedscope and Perfetto: one event for each box, with its whole time.
std::string flame_json(const std::vector<FlameBox>& boxes);

}  // namespace nezumi::draw
