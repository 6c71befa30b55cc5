// Mazes of square cells: their walls, read from a drawing or made from a seed, and as boxes of an arena.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "engine/world/arena_spec.hpp"

namespace nezumi {

/// A maze to be generated: there is exactly one way between any two cells. The south-west cell is open to the north.
struct MazePlan {
    int columns = 8;
    int rows = 8;
    std::int64_t seed = 1;
};

inline constexpr int most_maze_cells = 64;  ///< along one side

/// A maze as a system file describes it.
struct MazeSpec {
    MazePlan generate;
    double cell = 0.18;  ///< [m] distance of the middles of two walls: 0.18 as in contests, 0.09 in half-size ones
    double thickness = 0.012;  ///< [m] of walls and posts: 0.012 as in contests, 0.006 in half-size ones
    Point2D at{};              ///< [m] centre of the south-west cell
    Place place{};
};

inline constexpr double maze_height = 0.05;  ///< [m]

/// A cell, counted from 0 in the south-west corner.
struct MazeCell {
    int column = 0;
    int row = 0;
    bool operator==(const MazeCell&) const = default;
};

/// Quarter turns from east, counter-clockwise.
enum class MazeSide { east, north, west, south };
inline constexpr MazeSide maze_sides[] = {MazeSide::east, MazeSide::north, MazeSide::west, MazeSide::south};

/// The neighbour of a cell on this side, which may lie outside of the maze.
MazeCell beside(MazeCell cell, MazeSide side);

class Maze {
public:
    /// All walls stand if `closed`, else only those around the maze; all posts stand. 1 to `most_maze_cells` cells
    /// along a side.
    Maze(int columns, int rows, bool closed);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    bool has(MazeCell cell) const {
        return cell.column >= 0 && cell.column < columns_ && cell.row >= 0 && cell.row < rows_;
    }
    /// Whether a cell of the maze has a wall on this side.
    bool is_wall(MazeCell cell, MazeSide side) const;
    void set_wall(MazeCell cell, MazeSide side, bool stands);

    /// The cells that the drawing marks with S and G.
    std::optional<MazeCell> marked_start;
    std::vector<MazeCell> marked_goals;
    /// The marked start, or the south-west cell.
    MazeCell start() const { return marked_start.value_or(MazeCell{}); }
    /// The marked goals, or else the cells in the middle: 4, 2 or 1 cells, because the numbers of columns and rows can
    /// be even or odd.
    std::vector<MazeCell> goals() const;
    /// The direction of the mouse at the start: north if there is no wall, else the first side without a wall (east,
    /// south, west).
    MazeSide start_side() const;

    /// Whether there is a post or a wall at this place of the lattice. Columns and lines count from the north-west
    /// corner: both are even for a post, one is even for a wall, none for a cell.
    bool stands(int column, int line) const { return lattice_[index(column, line)]; }
    void set(int column, int line, bool stands) { lattice_[index(column, line)] = stands; }
    bool operator==(const Maze&) const = default;

private:
    std::size_t index(int column, int line) const {
        return static_cast<std::size_t>(line) * static_cast<std::size_t>(2 * columns_ + 1) +
               static_cast<std::size_t>(column);
    }
    int columns_, rows_;
    std::vector<bool> lattice_;
};

/// Generates a maze by depth-first search. The same plan gives the same maze.
Maze generate_maze(const MazePlan& plan);

/// An error in a drawing; `row` counts from 1, and 0 means the whole drawing.
struct MazeProblem {
    std::string text;
    std::size_t row = 0;
};

/// Reads a drawing, north at the top: cells share their edges and are two rows high.
///     o---o---o
///     |     G |
///     o   o---o
///     | S |   |
///     o---o---o
/// The distance of posts in the first row is the width of a cell: at least 2 characters, in drawings of contests 4.
/// Posts may be any character, or blanks. S and G mark start and goals, in lower case too; other letters and digits in
/// cells are ignored. Blanks at the end of a row may be missing, all rows may be indented, tabs reach to the next cell,
/// rows may end with CR.
tl::expected<Maze, MazeProblem> read_drawing(std::vector<std::string> rows);

/// Draws a maze as in contests, with this character for the posts.
std::vector<std::string> draw_maze(const Maze& maze, char post = 'o');

/// The boxes of a maze: connected walls in one line are one box, and a post without walls is a box.
std::vector<BoxSpec> walls_of(const Maze& maze, const MazeSpec& spec);

}  // namespace nezumi
