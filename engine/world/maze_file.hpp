// Files of mazes, as the micromouse community keeps them: drawings, `.maz` and `.num`.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/world/maze.hpp"

namespace nezumi {

/// Reads a maze from the content of a file with any name:
/// - a drawing, as `read_drawing` reads it. Text before and after it is ignored.
/// - bytes, one for each cell of a square maze (256 for 16 x 16 cells), by columns from the west, each from the south.
///   The bits 1, 2, 4 and 8 are walls in the north, east, south and west.
/// - numbers, a line for each cell: "X Y N E S W", cells from 0 in the south-west, 1 for a wall.
/// Errors have `file`, the line if there is one, what was found and what was expected. Two cells that disagree about
/// the wall between them are an error.
Expected<Maze> read_maze(std::string_view content, const std::string& file);

/// The formats that `write_maze` can write.
enum class MazeFormat {
    contest,  ///< a drawing with posts `o`
    map,      ///< a drawing with posts `+`
    maz,      ///< bytes; only for 16 x 16 cells
    num,      ///< numbers
};
inline constexpr std::array<std::string_view, 4> maze_formats{"txt", "map", "maz", "num"};

/// The content of a file. An error if the format can't hold this maze.
Expected<std::string> write_maze(const Maze& maze, MazeFormat format);

}  // namespace nezumi
