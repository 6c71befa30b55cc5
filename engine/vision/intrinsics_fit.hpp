// Finds a chessboard in pictures and computes the lens's intrinsics from its corners.
#pragma once

#include <optional>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/vision/checked_image.hpp"

namespace nezumi {

/// The number of inner corners, where four squares meet. One even and one odd number make top and bottom different.
struct BoardSize {
    int columns = 9, rows = 6;
};

/// The inner corners [px], row by row.
using Corners = std::vector<Point2D>;

/// Finds the corners with subpixel accuracy; nothing unless the whole board is visible.
std::optional<Corners> find_corners(const GrayImage& image, const BoardSize& board);

/// The mean distance [px] between the corners of two views of the same board.
double mean_distance(const Corners& a, const Corners& b);

struct IntrinsicsFit {
    CameraIntrinsics intrinsics;
    double error = 0;  ///< [px] root mean square error of the corners
};

/// Fits the intrinsics with five distortion coefficients by Zhang's method (cv::calibrateCamera). The size of the
/// squares has no influence. `width`, `height` [px] are the size of the pictures. Fails if the corners of a view fit no
/// lens model (for example of a bent board). Also fails if the views are too similar: the focal length is uncertain by
/// more than 2 %, or no two boards differ by at least 20 degrees.
Expected<IntrinsicsFit> fit_intrinsics(const std::vector<Corners>& views, const BoardSize& board, int width,
                                       int height);

}  // namespace nezumi
