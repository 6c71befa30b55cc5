// OpenCV finds the corners, refines them, and calibrates.
#include "engine/vision/intrinsics_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace nezumi {
namespace {

constexpr double most_error = 1.0 / 640;   // relative to the pictures' width: larger errors fit no lens
constexpr double most_uncertainty = 0.02;  // standard deviation, relative to the focal lengths
constexpr double least_turn = 20;          // [degrees] between the two most different views of the board

// The largest angle [degrees] between the board's normals in two views. Views with the same normal do not determine a
// focal length, and the deviations of calibrateCamera don't show that: they leave out undetermined parameters.
double largest_turn(const std::vector<cv::Mat>& rotations) {
    std::vector<cv::Vec3d> normals;
    for (const cv::Mat& rotation : rotations) {
        cv::Matx33d matrix;
        cv::Rodrigues(rotation, matrix);
        normals.emplace_back(matrix(0, 2), matrix(1, 2), matrix(2, 2));
    }
    double least = 1;  // cosine
    for (const cv::Vec3d& a : normals) {
        for (const cv::Vec3d& b : normals) least = std::min(least, a.dot(b));
    }
    return std::acos(std::clamp(least, -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace

std::optional<Corners> find_corners(const GrayImage& image, const BoardSize& board) {
    const cv::Mat gray(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
    std::vector<cv::Point2f> found;
    // CALIB_CB_NORMALIZE_IMAGE is not used: it finds no additional boards, and is ten times slower without a board.
    const int flags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_FAST_CHECK;
    if (!cv::findChessboardCorners(gray, {board.columns, board.rows}, found, flags)) return std::nullopt;
    // The window must not reach the next corner.
    const int reach = std::clamp(static_cast<int>(cv::norm(found[1] - found[0]) / 3), 2, 8);
    cv::cornerSubPix(gray, found, {reach, reach}, {-1, -1},
                     {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01});
    Corners corners;
    for (const cv::Point2f& corner : found) corners.push_back({corner.x, corner.y});
    return corners;
}

double mean_distance(const Corners& a, const Corners& b) {
    return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                                 [](const Point2D& p, const Point2D& q) { return std::hypot(p.x - q.x, p.y - q.y); }) /
           static_cast<double>(a.size());
}

Expected<IntrinsicsFit> fit_intrinsics(const std::vector<Corners>& views, const BoardSize& board, int width,
                                       int height) {
    std::vector<cv::Point3f> squares;
    for (int row = 0; row < board.rows; ++row) {
        for (int column = 0; column < board.columns; ++column)
            squares.emplace_back(static_cast<float>(column), static_cast<float>(row), 0.0F);
    }
    const std::vector<std::vector<cv::Point3f>> places(views.size(), squares);
    std::vector<std::vector<cv::Point2f>> seen;
    for (const Corners& view : views) {
        seen.emplace_back();
        for (const Point2D& corner : view)
            seen.back().emplace_back(static_cast<float>(corner.x), static_cast<float>(corner.y));
    }
    cv::Matx33d matrix = cv::Matx33d::eye();
    cv::Mat distortion;
    std::vector<double> deviations;
    std::vector<cv::Mat> rotations, shifts;
    double error = 0;
    try {
        error = cv::calibrateCamera(places, seen, {width, height}, matrix, distortion, rotations, shifts, deviations,
                                    cv::noArray(), cv::noArray());
    } catch (const cv::Exception& thrown) {
        return failure(fmt::format("no lens model fits these views of the board: {}", thrown.err));
    }
    const double fx = matrix(0, 0), fy = matrix(1, 1);
    const bool is_sure = std::max(deviations[0] / fx, deviations[1] / fy) < most_uncertainty;
    if (!is_sure || !(largest_turn(rotations) > least_turn))
        return failure(
            "the views are too similar to determine the focal length: hold the board tilted, to all sides, by "
            "30 degrees or more");
    if (!(error < most_error * width))
        return failure(
            fmt::format("the corners are {:.2f} px away from every possible lens: is the board flat, has it {} x {} "
                        "inner corners, and was it held still?",
                        error, board.columns, board.rows));
    const auto coefficient = [&](int index) { return distortion.at<double>(index); };
    return IntrinsicsFit{.intrinsics = {.width = static_cast<std::uint16_t>(width),
                                        .height = static_cast<std::uint16_t>(height),
                                        .fx = fx,
                                        .fy = fy,
                                        .cx = matrix(0, 2),
                                        .cy = matrix(1, 2),
                                        .k1 = coefficient(0),
                                        .k2 = coefficient(1),
                                        .p1 = coefficient(2),
                                        .p2 = coefficient(3),
                                        .k3 = coefficient(4)},
                         .error = error};
}

}  // namespace nezumi
