// Files are made in memory first, so that an error does not leave an incomplete file.
#include "bindings/draw/canvas.hpp"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/base/number_in.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::draw {
cairo_status_t append_to_string(void* text, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

Colour Colour::shaded(double amount) const {
    const auto shade = [amount](double value) {
        return amount < 0 ? value * (1 + amount) : value + (1 - value) * amount;
    };
    return {shade(red), shade(green), shade(blue), alpha};
}

Colour colour_of(std::string_view text) {
    constexpr unsigned grey = 0x8a8f98;
    const bool is_color = text.size() == 7 && text.front() == '#';
    const unsigned value = is_color ? number_in<unsigned>(text.substr(1), 16).value_or(grey) : grey;
    const auto part = [value](int shift) { return ((value >> shift) & 255) / 255.0; };
    return {part(16), part(8), part(0)};
}

Colour series_colour(std::size_t index) {
    // Okabe and Ito (2008), without black; yellow is last because it is faint on white.
    static constexpr std::array<std::string_view, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                             "#56b4e9", "#e69f00", "#b8a800"};
    return colour_of(colours[index % colours.size()]);
}

Canvas::Canvas(std::string file, double width, double height)
    : file_(std::move(file)), svg_(file_.ends_with(".svg")), width_(std::ceil(width)), height_(std::ceil(height)) {
    surface_.reset(
        svg_ ? cairo_svg_surface_create_for_stream(append_to_string, &bytes_, width_, height_)
             : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width_), static_cast<int>(height_)));
    context_.reset(cairo_create(surface_.get()));
    set(ink::paper);
    cairo_paint(context());
    cairo_set_line_join(context(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context(), CAIRO_LINE_CAP_ROUND);
}

void Canvas::choose_font(double size, bool bold) {
    cairo_select_font_face(context(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context(), size);
}

double Canvas::text_width(const std::string& words, double size, bool bold) {
    choose_font(size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(context(), words.c_str(), &extents);
    return extents.x_advance;
}

void Canvas::text(double x, double y, const std::string& words, double size, const Colour& colour, double anchor,
                  bool bold) {
    set(colour);
    cairo_move_to(context(), x - anchor * text_width(words, size, bold), y);
    cairo_show_text(context(), words.c_str());
}

void Canvas::image(Picture picture, double x, double y, double width, double height) {
    // `Picture` and cairo's RGB24 both store a pixel as 0x00rrggbb.
    const std::unique_ptr<cairo_surface_t, Release> surface(
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(picture.pixels.data()), CAIRO_FORMAT_RGB24,
                                            picture.width, picture.height, 4 * picture.width));
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return;
    const double scale = width / cairo_image_surface_get_width(surface.get());
    cairo_save(context());
    cairo_translate(context(), x, y);
    cairo_scale(context(), scale, height / cairo_image_surface_get_height(surface.get()));
    cairo_set_source_surface(context(), surface.get(), 0, 0);
    if (scale > 1) cairo_pattern_set_filter(cairo_get_source(context()), CAIRO_FILTER_NEAREST);
    cairo_paint(context());
    cairo_restore(context());
    cairo_surface_finish(surface.get());  // makes cairo copy the pixels if it still needs them
}

Expected<void> Canvas::write() {
    cairo_status_t status = cairo_status(context());
    if (!svg_ && status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_write_to_png_stream(surface_.get(), append_to_string, &bytes_);
    cairo_surface_finish(surface_.get());
    if (svg_ && status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS)
        return failure(fmt::format("can't be drawn: {}", cairo_status_to_string(status)), {file_});

    return write_whole(file_, bytes_);
}

}  // namespace nezumi::draw
