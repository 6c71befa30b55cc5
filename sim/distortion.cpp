// Applies lens distortion: OpenCV computes the source of each pixel and maps the picture.
#include "sim/distortion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace nezumi::sim {
namespace {

constexpr double most_error = 0.05;   // [px] largest round-trip error of a distorted point
constexpr double largest_growth = 3;  // limit of the pinhole picture's width and height, relative to the camera's

cv::Matx33d matrix_of(const CameraIntrinsics& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }
cv::Vec<double, 8> coefficients_of(const CameraIntrinsics& c) {
    return {c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6};
}

// The point on the plane z = 1 that each pixel sees, row by row.
std::vector<cv::Point2d> places_of_pixels(const CameraIntrinsics& intrinsics) {
    std::vector<cv::Point2d> pixels, places;
    for (int row = 0; row < intrinsics.height; ++row) {
        for (int column = 0; column < intrinsics.width; ++column) pixels.emplace_back(column, row);
    }
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-10);
    cv::undistortPoints(pixels, places, matrix_of(intrinsics), coefficients_of(intrinsics), cv::noArray(),
                        cv::noArray(), until);
    return places;
}

// Checks that the points, distorted again, give their pixels, and that each row is in order.
bool is_sound(const CameraIntrinsics& intrinsics, const std::vector<cv::Point2d>& places) {
    std::vector<cv::Point3d> points;
    points.reserve(places.size());
    for (const cv::Point2d& place : places) points.emplace_back(place.x, place.y, 1);
    std::vector<cv::Point2d> seen;
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix_of(intrinsics), coefficients_of(intrinsics), seen);
    const std::size_t width = intrinsics.width;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::size_t column = i % width, row = i / width;
        // Written with `!` so that NaN is refused too.
        if (!(std::hypot(seen[i].x - static_cast<double>(column), seen[i].y - static_cast<double>(row)) < most_error))
            return false;
        if (column > 0 && !(places[i].x > places[i - 1].x)) return false;
        if (row > 0 && !(places[i].y > places[i - width].y)) return false;
    }
    return true;
}

}  // namespace

Expected<Distortion> Distortion::make(const CameraIntrinsics& intrinsics) {
    const auto places = places_of_pixels(intrinsics);
    const auto [left, right] =
        std::minmax_element(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto [top, bottom] =
        std::minmax_element(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    // One more pixel on each side, because the outermost pixels are interpolated.
    const double columns = intrinsics.fx * (right->x - left->x) + 3, rows = intrinsics.fy * (bottom->y - top->y) + 3;
    const bool fits = columns <= largest_growth * intrinsics.width && rows <= largest_growth * intrinsics.height;
    if (!fits || !is_sound(intrinsics, places)) {
        const CameraIntrinsics& c = intrinsics;
        return failure(
            fmt::format("a distortion of k1 = {:g}, k2 = {:g}, p1 = {:g}, p2 = {:g}, k3 = {:g} folds the "
                        "picture over: take smaller ones, or a smaller field of view",
                        c.k1, c.k2, c.p1, c.p2, c.k3));
    }

    Distortion made;
    made.intrinsics_ = intrinsics;
    made.pinhole_ = {.width = static_cast<std::uint16_t>(std::ceil(columns)),
                     .height = static_cast<std::uint16_t>(std::ceil(rows)),
                     .fx = intrinsics.fx,
                     .fy = intrinsics.fy,
                     .cx = 1 - intrinsics.fx * left->x,
                     .cy = 1 - intrinsics.fy * top->y};

    cv::Mat exact(intrinsics.height, intrinsics.width, CV_32FC2);
    for (std::size_t i = 0; i < places.size(); ++i) {
        exact.at<cv::Vec2f>(static_cast<int>(i / intrinsics.width), static_cast<int>(i % intrinsics.width)) = {
            static_cast<float>(made.pinhole_.fx * places[i].x + made.pinhole_.cx),
            static_cast<float>(made.pinhole_.fy * places[i].y + made.pinhole_.cy)};
    }
    made.places_.resize(2 * places.size());
    made.weights_.resize(places.size());
    cv::Mat to(intrinsics.height, intrinsics.width, CV_16SC2, made.places_.data());
    cv::Mat weights(intrinsics.height, intrinsics.width, CV_16UC1, made.weights_.data());
    cv::convertMaps(exact, cv::noArray(), to, weights, CV_16SC2);
    return made;
}

void Distortion::apply(std::vector<std::uint8_t>& painted, int channels, std::vector<std::uint8_t>& distorted) const {
    distorted.resize(weights_.size() * static_cast<std::size_t>(channels));
    const cv::Mat from(pinhole_.height, pinhole_.width, CV_8UC(channels), painted.data());
    cv::Mat to(intrinsics_.height, intrinsics_.width, CV_8UC(channels), distorted.data());
    // cv::Mat has no constructor for const data; these two are only read.
    const cv::Mat places(to.size(), CV_16SC2, const_cast<std::int16_t*>(places_.data()));
    const cv::Mat weights(to.size(), CV_16UC1, const_cast<std::uint16_t*>(weights_.data()));
    cv::remap(from, to, places, weights, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
}

}  // namespace nezumi::sim
