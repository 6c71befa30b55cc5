// A chessboard in pictures, and what its corners' places there say of the lens.
#pragma once

#include <optional>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/vision/checked_image.hpp"

namespace nezumi {

/// Its inner corners, where four squares meet. One number even and one odd tell its top from its bottom.
struct BoardSize {
    int columns = 9, rows = 6;
};

/// Where its inner corners are [px], row by row.
using Corners = std::vector<Point2D>;

/// The corners to a fraction of a pixel; nothing unless the whole board is in sight.
std::optional<Corners> find_corners(const GrayImage& image, const BoardSize& board);

/// The mean distance [px] between the corners of two views of the same board.
double mean_distance(const Corners& a, const Corners& b);

struct IntrinsicsFit {
    CameraIntrinsics intrinsics;
    double error = 0;  ///< [px] root of the mean square by which the corners are off their places
};

/// The intrinsics with five coefficients of distortion, by Zhang's method as OpenCV has it (cv::calibrateCamera). The
/// size of the squares makes no difference. `width`, `height` [px] are the pictures'. An error when the corners of
/// some view don't lie where any lens has them (the board is bent), or when the views are so much alike that the focal
/// length is unsure by more than 2 %, or the board is turned by less than 20 degrees from any to any other.
Expected<IntrinsicsFit> fit_intrinsics(const std::vector<Corners>& views, const BoardSize& board, int width,
                                       int height);

}  // namespace nezumi
