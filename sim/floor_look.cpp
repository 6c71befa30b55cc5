// Looks down on a picture.
#include "sim/floor_look.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nezumi::sim {
namespace {

constexpr double spot = 0.004;  // [m] radius
constexpr int rim_points = 8;

struct Parts {
    double r, g, b;  // 0 to 255
};

Parts parts_of(Rgb color) {
    return {static_cast<double>(color >> 16 & 0xff), static_cast<double>(color >> 8 & 0xff),
            static_cast<double>(color & 0xff)};
}

std::optional<Parts> pixel_at(const Picture& picture, const Point2D& size, double x, double y) {
    const double column = std::floor((x / size.x + 0.5) * picture.width);
    const double row = std::floor((0.5 - y / size.y) * picture.height);
    // Also refuses what is no number.
    if (!(column >= 0 && column < picture.width && row >= 0 && row < picture.height)) return std::nullopt;
    const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width);
    return parts_of(picture.pixels[index + static_cast<std::size_t>(column)]);
}

// [degrees] 0 red, 120 green, 240 blue; `range` is the largest part less the smallest, not 0.
double hue_of(const Parts& c, double range) {
    double sixth = 0;
    if (c.r >= c.g && c.r >= c.b) {
        sixth = (c.g - c.b) / range;
    } else if (c.g >= c.b) {
        sixth = 2 + (c.b - c.r) / range;
    } else {
        sixth = 4 + (c.r - c.g) / range;
    }
    return sixth < 0 ? 60 * (sixth + 6) : 60 * sixth;
}

}  // namespace

std::optional<Rgb> look_at_floor(const Picture& picture, const Point2D& size, const Point2D& at) {
    const auto centre = pixel_at(picture, size, at.x, at.y);
    if (!centre) return std::nullopt;
    Parts sum = *centre;
    int count = 1;
    for (int i = 0; i < rim_points; ++i) {
        const double angle = 2 * std::numbers::pi * i / rim_points;
        const auto seen = pixel_at(picture, size, at.x + spot * std::cos(angle), at.y + spot * std::sin(angle));
        if (!seen) continue;
        sum = {sum.r + seen->r, sum.g + seen->g, sum.b + seen->b};
        ++count;
    }
    const auto mean = [count](double total) { return static_cast<Rgb>(std::lround(total / count)); };
    return mean(sum.r) << 16 | mean(sum.g) << 8 | mean(sum.b);
}

FloorColor nearest_floor_color(Rgb color) {
    const Parts c = parts_of(color);
    const double largest = std::max({c.r, c.g, c.b}), range = largest - std::min({c.r, c.g, c.b});
    if (largest < 45) return FloorColor::black;
    if (range < 0.2 * largest) return largest < 110 ? FloorColor::black : FloorColor::white;
    const double hue = hue_of(c, range);
    // Brown is a dark orange, or a dark red that is not pure.
    const bool is_dark = largest < 180;
    if (hue < 12 || hue >= 330) return is_dark && range < 0.8 * largest ? FloorColor::brown : FloorColor::red;
    if (hue < 50 && is_dark) return FloorColor::brown;
    if (hue < 25) return FloorColor::red;
    if (hue < 70) return FloorColor::yellow;
    if (hue < 170) return FloorColor::green;
    return hue < 280 ? FloorColor::blue : FloorColor::red;
}

double brightness(Rgb color) {
    const Parts c = parts_of(color);
    return (0.299 * c.r + 0.587 * c.g + 0.114 * c.b) / 2.55;
}

}  // namespace nezumi::sim
