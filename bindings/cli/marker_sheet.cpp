// Lengths are metres everywhere; only the page is told in the points of PDF.
#include "bindings/cli/marker_sheet.hpp"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sim/picture.hpp"

namespace nezumi::cli {
namespace {

constexpr double points_per_metre = 72 / 0.0254;
constexpr double unprintable = 0.005;   // [m] at the edges of a sheet, for most printers
constexpr double text_size = 0.004;     // [m]
constexpr double lines_height = 0.020;  // [m] of what stands below a marker
constexpr double ruler = 0.05;          // [m]

constexpr double cells_across = static_cast<double>(sim::tag_cells) / sim::tag_border_cells;

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

void draw_text(cairo_t* context, double middle, double y, const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(context, text.c_str(), &extents);
    cairo_move_to(context, middle - extents.x_advance / 2, y);
    cairo_show_text(context, text.c_str());
}

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

void draw_marker(cairo_t* context, const Paper& paper, int id, double size) {
    const sim::Picture tag = sim::paint_tag(id);
    const double cell = size / sim::tag_border_cells;
    const double left = (paper.width - cell * tag.width) / 2;
    const double top = (paper.height - cell * tag.height) / 2;
    cairo_set_source_rgb(context, 0, 0, 0);
    // One path, filled at once: between cells that are filled one by one, viewers show hairlines.
    for (int row = 0; row < tag.height; ++row) {
        for (int column = 0; column < tag.width; ++column) {
            const bool is_black = (tag.pixels[static_cast<std::size_t>(row * tag.width + column)] & 0xff) < 0x80;
            if (is_black) cairo_rectangle(context, left + column * cell, top + row * cell, cell, cell);
        }
    }
    cairo_fill(context);

    const double middle = paper.width / 2;
    const double below = top + cell * tag.height + 1.5 * text_size;
    cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, text_size);
    draw_text(context, middle, below, fmt::format("AprilTag 36h11, id = {}, size = {}", id, size));
    draw_text(context, middle, below + 1.5 * text_size,
              fmt::format("print without scaling: this line is {:.0f} mm long", ruler * 1000));
    cairo_set_line_width(context, 0.0003);
    const double y = below + 2.25 * text_size;
    cairo_move_to(context, middle - ruler / 2, y);
    cairo_line_to(context, middle + ruler / 2, y);
    for (const double end : {middle - ruler / 2, middle + ruler / 2}) {
        cairo_move_to(context, end, y - text_size / 4);
        cairo_line_to(context, end, y + text_size / 4);
    }
    cairo_stroke(context);
}

Expected<std::string> marker_pdf(const Paper& paper, const std::vector<int>& ids, double size) {
    std::string bytes;
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_pdf_surface_create_for_stream(append, &bytes, paper.width * points_per_metre,
                                            paper.height * points_per_metre),
        cairo_surface_destroy);
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(context.get(), points_per_metre, points_per_metre);
    for (const int id : ids) {
        draw_marker(context.get(), paper, id, size);
        cairo_show_page(context.get());
    }
    cairo_surface_finish(surface.get());
    for (const cairo_status_t status : {cairo_status(context.get()), cairo_surface_status(surface.get())}) {
        if (status != CAIRO_STATUS_SUCCESS)
            return failure(fmt::format("marker: can't be drawn: {}", cairo_status_to_string(status)));
    }
    return bytes;
}

}  // namespace nezumi::cli
