// A sheet for drawing with cairo, written as a PNG or SVG file.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/world/picture.hpp"

namespace nezumi::draw {

struct Colour {
    double red = 0, green = 0, blue = 0, alpha = 1;  ///< 0 to 1
    Colour with_alpha(double a) const { return {red, green, blue, a}; }
    /// Returns a colour nearer to black (`amount` from -1 to 0) or to white (0 to 1).
    Colour shaded(double amount) const;
};

/// Parses "#rrggbb"; returns grey for any other text.
Colour colour_of(std::string_view text);
/// Colours that colour-blind people can distinguish; they repeat after the last.
Colour series_colour(std::size_t index);

namespace ink {
inline constexpr Colour paper{1, 1, 1};
inline constexpr Colour text{0.13, 0.16, 0.20};
inline constexpr Colour faint{0.45, 0.49, 0.54};
}  // namespace ink

/// A write function for cairo: appends to the std::string at `text`.
cairo_status_t append_to_string(void* text, const unsigned char* data, unsigned int length);

class Canvas {
public:
    /// `file` must end in .png or .svg, which decides the format. Only `write` writes the file. Sizes are in pixels.
    Canvas(std::string file, double width, double height);
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    cairo_t* context() { return context_.get(); }
    double width() const { return width_; }
    double height() const { return height_; }

    void set(const Colour& colour) {
        cairo_set_source_rgba(context(), colour.red, colour.green, colour.blue, colour.alpha);
    }
    /// Draws text; positions and size are in the present units of cairo. `anchor`: 0: the text starts at x, 0.5: it is
    /// centred on x, 1: it ends at x.
    void text(double x, double y, const std::string& words, double size, const Colour& colour, double anchor = 0,
              bool bold = false);
    /// Draws a picture in this rectangle. Enlarged pixels stay sharp.
    void image(Picture picture, double x, double y, double width, double height);
    double text_width(const std::string& words, double size, bool bold = false);

    /// Completes the drawing and writes the file. On an error there is no file.
    Expected<void> write();

private:
    struct Release {
        void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
        void operator()(cairo_t* context) const { cairo_destroy(context); }
    };
    void choose_font(double size, bool bold);

    std::string file_;
    bool svg_;
    double width_, height_;
    std::string bytes_;  // of the file; declared before `surface_`, which writes into them
    std::unique_ptr<cairo_surface_t, Release> surface_;
    std::unique_ptr<cairo_t, Release> context_;
};

}  // namespace nezumi::draw
