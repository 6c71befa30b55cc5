// Margins of printers, and the space for text below a marker.
#include "bindings/draw/paper.hpp"

#include <algorithm>

namespace nezumi::draw {
namespace {

constexpr double unprintable = 0.005;   // [m] margin at the edges of a sheet for most printers
constexpr double lines_height = 0.020;  // [m] height of the text below a marker

constexpr double cells_across = static_cast<double>(tag_cells) / tag_border_cells;

}  // namespace

const std::vector<Paper>& papers() {
    static const std::vector<Paper> all{
        {"A4", 0.210, 0.297}, {"A5", 0.148, 0.210}, {"A3", 0.297, 0.420}, {"letter", 0.2159, 0.2794}};
    return all;
}

double largest_marker(const Paper& paper) {
    const double room = std::min(paper.width, paper.height - 2 * lines_height) - 2 * unprintable;
    return room / cells_across;
}

}  // namespace nezumi::draw
