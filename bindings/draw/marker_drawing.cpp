// Lengths are in metres.
#include "bindings/draw/marker_drawing.hpp"

#include <fmt/format.h>

#include <string>

namespace nezumi::draw {
namespace {

constexpr double letter_size = 0.004;  // [m]
constexpr double ruler = 0.05;         // [m]

void draw_text(cairo_t* context, double middle, double y, const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(context, text.c_str(), &extents);
    cairo_move_to(context, middle - extents.x_advance / 2, y);
    cairo_show_text(context, text.c_str());
}

}  // namespace

void draw_marker(cairo_t* context, const Paper& paper, const PrintedTag& tag, double size) {
    const Picture& cells = tag.cells;
    const double cell = size / tag_border_cells;
    const double left = (paper.width - cell * cells.width) / 2;
    const double top = (paper.height - cell * cells.height) / 2;
    cairo_set_source_rgb(context, 0, 0, 0);
    // One path, filled at once: viewers show thin gaps between cells that are filled one by one.
    for (int row = 0; row < cells.height; ++row) {
        for (int column = 0; column < cells.width; ++column) {
            const bool is_black = (cells.pixels[static_cast<std::size_t>(row * cells.width + column)] & 0xff) < 0x80;
            if (is_black) cairo_rectangle(context, left + column * cell, top + row * cell, cell, cell);
        }
    }
    cairo_fill(context);

    const double middle = paper.width / 2;
    const double below = top + cell * cells.height + 1.5 * letter_size;
    cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, letter_size);
    draw_text(context, middle, below, fmt::format("AprilTag 36h11, id = {}, size = {}", tag.id, size));
    draw_text(context, middle, below + 1.5 * letter_size,
              fmt::format("print without scaling: this line is {:.0f} mm long", ruler * 1000));
    cairo_set_line_width(context, 0.0003);
    const double y = below + 2.25 * letter_size;
    cairo_move_to(context, middle - ruler / 2, y);
    cairo_line_to(context, middle + ruler / 2, y);
    for (const double end : {middle - ruler / 2, middle + ruler / 2}) {
        cairo_move_to(context, end, y - letter_size / 4);
        cairo_line_to(context, end, y + letter_size / 4);
    }
    cairo_stroke(context);
}

}  // namespace nezumi::draw
