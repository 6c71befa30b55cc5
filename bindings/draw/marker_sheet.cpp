// Lengths are in metres; only the size of the page is in PDF's points.
#include "bindings/draw/marker_sheet.hpp"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <memory>

#include "bindings/draw/canvas.hpp"
#include "bindings/draw/marker_drawing.hpp"

namespace nezumi::draw {
namespace {

constexpr double points_per_metre = 72 / 0.0254;

}  // namespace

Expected<std::string> marker_pdf(const Paper& paper, const std::vector<PrintedTag>& tags, double size) {
    std::string bytes;
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_pdf_surface_create_for_stream(append_to_string, &bytes, paper.width * points_per_metre,
                                            paper.height * points_per_metre),
        cairo_surface_destroy);
    cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);  // understood by every printer
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(context.get(), points_per_metre, points_per_metre);
    for (const PrintedTag& tag : tags) {
        draw_marker(context.get(), paper, tag, size);
        cairo_show_page(context.get());
    }
    cairo_surface_finish(surface.get());
    for (const cairo_status_t status : {cairo_status(context.get()), cairo_surface_status(surface.get())}) {
        if (status != CAIRO_STATUS_SUCCESS)
            return failure(fmt::format("marker: can't be drawn: {}", cairo_status_to_string(status)));
    }
    return bytes;
}

}  // namespace nezumi::draw
