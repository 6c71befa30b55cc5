// Makes a thin box for each square, and a ring of white squares around the board.
#include "engine/world/chessboard.hpp"

#include <cmath>
#include <numbers>

namespace nezumi {

std::vector<BoxSpec> chessboard(const ChessboardSpec& spec) {
    constexpr double thickness = 0.001;  // [m]
    const int columns = spec.columns + 1, rows = spec.rows + 1;
    std::vector<BoxSpec> squares;
    for (int column = -1; column <= columns; ++column) {
        for (int row = -1; row <= rows; ++row) {
            const bool is_margin = column < 0 || row < 0 || column == columns || row == rows;
            const bool is_black = !is_margin && (column + row) % 2 == 0;
            squares.push_back({.at = {spec.at.x + (column - (columns - 1) / 2.0) * spec.square,
                                      spec.at.y + (row - (rows - 1) / 2.0) * spec.square, thickness / 2},
                               .size = {spec.square, spec.square, thickness},
                               .color = is_black ? "#101010" : "#f0f0f0"});
        }
    }
    return squares;
}

CameraMount view_of_chessboard(const ChessboardSpec& spec, int number) {
    constexpr double pi = std::numbers::pi;
    // Steps of the golden angle never repeat a direction around the board. Elevations and distances alternate.
    const double around = number * pi * (3 - std::sqrt(5.0));
    const double elevation = (45 + 13 * (number % 4)) * pi / 180;
    const double length = (spec.columns + 1) * spec.square;
    const double distance = length * (1.36 + 0.16 * (number % 3));
    const Point2D aim{spec.at.x + length / 4 * std::cos(2.0 * number), spec.at.y + length / 4 * std::sin(3.0 * number)};
    const double level = distance * std::cos(elevation);
    return {.at = {aim.x - level * std::cos(around), aim.y - level * std::sin(around), distance * std::sin(elevation)},
            .yaw = around,
            .pitch = elevation};
}

}  // namespace nezumi
