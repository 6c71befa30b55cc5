// Reads the floor's colour from its picture.
#include "sim/floor_spot.hpp"

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
    // Written with `!` so that NaN is refused too.
    if (!(column >= 0 && column < picture.width && row >= 0 && row < picture.height)) return std::nullopt;
    const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width);
    return parts_of(picture.pixels[index + static_cast<std::size_t>(column)]);
}

}  // namespace

std::optional<Rgb> floor_spot_color(const Picture& picture, const Point2D& size, const Point2D& at) {
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

}  // namespace nezumi::sim
