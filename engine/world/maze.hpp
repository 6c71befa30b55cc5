// Mazes of square cells, drawn as text or made from a seed, and their walls as boxes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/world/arena_spec.hpp"

namespace nezumi {

/// A maze to be made: between any two cells there is exactly one way. From the south-west cell it leads north.
struct MazePlan {
    int columns = 8;
    int rows = 8;
    std::int64_t seed = 1;
};

inline constexpr int most_maze_cells = 64;  ///< along one side

/// A maze of cells that share their walls.
struct MazeSpec {
    std::vector<std::string> rows;  ///< as `draw_maze` gives them; empty: as `generate` says
    MazePlan generate;
    double cell = 0.18;  ///< [m] from the middle of a wall to that of the next: 0.18 is that of the contests
    Point2D at{};        ///< [m] centre of the south-west cell
    Place place{};
};

inline constexpr double maze_wall = 0.012;   ///< [m] thickness of walls and posts, as in the contests of micromice
inline constexpr double maze_height = 0.05;  ///< [m]

/// A maze as text, the north first: a cell is three columns by two rows that share their edges.
///     +--+--+
///     |     |
///     +  +--+
///     |  |  |
///     +--+--+
/// Made by a walk that turns back where it finds no new cell (depth-first search); the same plan gives the same maze.
std::vector<std::string> draw_maze(const MazePlan& plan);

/// What is wrong with a drawing, in words, or ""; `row` counts from 1.
struct MazeProblem {
    std::string text;
    std::size_t row = 0;
};
MazeProblem check_maze(const std::vector<std::string>& rows);

/// The walls of a drawing that is good: those in one line are one box; a post without walls is a box of its own.
std::vector<BoxSpec> walls_of(const std::vector<std::string>& rows, double cell, const Point2D& at);

}  // namespace nezumi
