// A segment of a line is a rectangle and a point a disc. Both are polygons, because a pixel may not be square.
#include "sim/paint_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/scenery.hpp"

namespace nezumi::sim {
namespace {

constexpr double finest = 0.001;           // [m] edge of a pixel
constexpr double most_floor_pixels = 4e6;  // of a floor without a picture of its own
constexpr int corners = 32;                // of a disc

int pixels_along(double length, double pixel) { return std::max(1, static_cast<int>(std::lround(length / pixel))); }

}  // namespace

Picture plain_floor(const Point2D& size) {
    const double pixel = std::max(finest, std::sqrt(size.x * size.y / most_floor_pixels));
    Picture floor{pixels_along(size.x, pixel), pixels_along(size.y, pixel), {}};
    floor.pixels.assign(static_cast<std::size_t>(floor.width) * static_cast<std::size_t>(floor.height),
                        plain_floor_color);
    return floor;
}

void paint_line(Picture& floor, const Point2D& size, const LineSpec& line) {
    // OpenCV takes corners in fractions of a pixel; the centre of a pixel is an integer.
    constexpr int shift = 6;
    constexpr double fraction = 1 << shift;
    static_assert(sizeof(Rgb) == 4);
    cv::Mat canvas(floor.height, floor.width, CV_8UC4, floor.pixels.data());
    const Rgb color = parse_color(line.color);
    const cv::Scalar bytes(color & 0xff, color >> 8 & 0xff, color >> 16 & 0xff, 0);  // in memory order
    const auto pixel = [&](double x, double y) {
        return cv::Point(static_cast<int>(std::lround(((x / size.x + 0.5) * floor.width - 0.5) * fraction)),
                         static_cast<int>(std::lround(((0.5 - y / size.y) * floor.height - 0.5) * fraction)));
    };
    const double half = line.width / 2;
    std::vector<cv::Point> polygon;
    const auto fill = [&] {
        cv::fillConvexPoly(canvas, polygon, bytes, cv::LINE_8, shift);
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
