// A chessboard that lies on the floor, for cameras that are calibrated in simulation.
#pragma once

#include <vector>

#include "engine/world/arena_spec.hpp"
#include "engine/world/camera_source.hpp"

namespace nezumi {

struct ChessboardSpec {
    int columns = 9, rows = 6;  ///< inner corners along x and along y
    double square = 0.025;      ///< [m] edge of a square
    Point2D at{3, 0};           ///< [m] its centre
    bool operator==(const ChessboardSpec&) const = default;
};

/// Its squares, black and white, with a white margin as wide as one.
std::vector<BoxSpec> chessboard(const ChessboardSpec& spec);

/// Where a camera is held over it for the view with this number, counted from 0: all around it, from high and low, near
/// and far.
CameraMount view_of_chessboard(const ChessboardSpec& spec, int number);

}  // namespace nezumi
