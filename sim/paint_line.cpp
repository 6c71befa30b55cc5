// Paints each segment of a line as a rectangle, and each point as a disc. Both are polygons: pixels may not be square.
#include "sim/paint_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/scenery.hpp"

namespace nezumi::sim {
namespace {

constexpr double finest = 0.001;           // [m] edge of a pixel
constexpr double most_floor_pixels = 4e6;  // of a floor without a picture
constexpr int corners = 32;                // of a disc

int pixels_along(double length, double pixel) { return std::max(1, static_cast<int>(std::lround(length / pixel))); }

// Paints the pixels whose centres are within the convex polygon.
void fill_convex(Picture& picture, const std::vector<Point2D>& polygon, Rgb color) {
    const auto [top, bottom] = std::minmax_element(polygon.begin(), polygon.end(),
                                                   [](const Point2D& a, const Point2D& b) { return a.y < b.y; });
    const int last = static_cast<int>(std::min(std::floor(bottom->y), picture.height - 1.0));
    for (int row = static_cast<int>(std::max(std::ceil(top->y), 0.0)); row <= last; ++row) {
        double left = picture.width, right = -1;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point2D& a = polygon[i];
            const Point2D& b = polygon[(i + 1) % polygon.size()];
            if (std::min(a.y, b.y) > row || std::max(a.y, b.y) < row) continue;
            const double x = a.y == b.y ? a.x : a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x);
            left = std::min(left, x);
            right = std::max(right, a.y == b.y ? std::max(x, b.x) : x);
        }
        const int from = static_cast<int>(std::max(std::ceil(left), 0.0));
        const int to = static_cast<int>(std::min(std::floor(right), picture.width - 1.0));
        Rgb* const pixels =
            picture.pixels.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width);
        if (from <= to) std::fill(pixels + from, pixels + to + 1, color);
    }
}

}  // namespace

Picture plain_floor(const Point2D& size) {
    const double pixel = std::max(finest, std::sqrt(size.x * size.y / most_floor_pixels));
    Picture floor{pixels_along(size.x, pixel), pixels_along(size.y, pixel), {}};
    floor.pixels.assign(static_cast<std::size_t>(floor.width) * static_cast<std::size_t>(floor.height),
                        plain_floor_color);
    return floor;
}

void paint_line(Picture& floor, const Point2D& size, const LineSpec& line) {
    const Rgb color = parse_color(line.color);
    const auto pixel = [&](double x, double y) {  // the centre of a pixel is an integer
        return Point2D{(x / size.x + 0.5) * floor.width - 0.5, (0.5 - y / size.y) * floor.height - 0.5};
    };
    const double half = line.width / 2;
    std::vector<Point2D> polygon;
    const auto fill = [&] {
        fill_convex(floor, polygon, color);
        polygon.clear();
    };
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Point2D& at = line.points[i];
        for (int k = 0; k < corners; ++k) {
            const double angle = 2 * std::numbers::pi * k / corners;
            polygon.push_back(pixel(at.x + half * std::cos(angle), at.y + half * std::sin(angle)));
        }
        fill();
        if (i == 0) continue;
        const Point2D& from = line.points[i - 1];
        const double length = std::hypot(at.x - from.x, at.y - from.y);
        if (length == 0) continue;
        const double x = -(at.y - from.y) / length * half, y = (at.x - from.x) / length * half;
        polygon = {pixel(from.x + x, from.y + y), pixel(at.x + x, at.y + y), pixel(at.x - x, at.y - y),
                   pixel(from.x - x, from.y - y)};
        fill();
    }
}

}  // namespace nezumi::sim
