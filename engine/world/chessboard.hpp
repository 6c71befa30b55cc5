// A chessboard on the floor, for calibrating cameras in simulation.
#pragma once

#include <vector>

#include "engine/world/arena_spec.hpp"
#include "engine/world/camera_source.hpp"

namespace nezumi {

struct ChessboardSpec {
    int columns = 9, rows = 6;  ///< inner corners along x and along y
    double square = 0.025;      ///< [m] edge of a square
    Point2D at{3, 0};           ///< [m] centre of the board
    bool operator==(const ChessboardSpec&) const = default;
};

/// The squares, black and white, with a white margin of the width of a square.
std::vector<BoxSpec> chessboard(const ChessboardSpec& spec);

/// The position of the camera for the view with this number, counted from 0: around the board, high and low, near and
/// far.
CameraMount view_of_chessboard(const ChessboardSpec& spec, int number);

}  // namespace nezumi
