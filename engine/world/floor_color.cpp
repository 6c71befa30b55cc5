// Names of colours and the limits between them.
#include "engine/world/floor_color.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace nezumi {
namespace {

struct Parts {
    double r, g, b;  // 0 to 255
};

Parts parts_of(Rgb color) {
    return {static_cast<double>(color >> 16 & 0xff), static_cast<double>(color >> 8 & 0xff),
            static_cast<double>(color & 0xff)};
}

// [degrees] 0 red, 120 green, 240 blue; `range` is the largest component minus the smallest, not 0.
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

std::string_view to_text(FloorColor color) {
    constexpr std::array<std::string_view, 8> names{"none",   "black", "blue",  "green",
                                                    "yellow", "red",   "white", "brown"};
    return names[static_cast<std::size_t>(color)];
}

FloorColor nearest_floor_color(Rgb color) {
    const Parts c = parts_of(color);
    const double largest = std::max({c.r, c.g, c.b}), range = largest - std::min({c.r, c.g, c.b});
    if (largest < 45) return FloorColor::black;
    if (range < 0.2 * largest) return largest < 110 ? FloorColor::black : FloorColor::white;
    const double hue = hue_of(c, range);
    // Brown is dark orange, or a dark red that is not pure.
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

}  // namespace nezumi
