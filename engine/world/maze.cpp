// A maze is a lattice: posts at even lines and columns, walls between them, cells where both are odd.
#include "engine/world/maze.hpp"

#include <array>
#include <random>

namespace nezumi {
namespace {

// A box from one post's middle to another's, with square ends.
BoxSpec wall_between(const Point2D& from, const Point2D& to, double thickness) {
    BoxSpec box;
    box.at = {(from.x + to.x) / 2, (from.y + to.y) / 2, maze_height / 2};
    box.size = {to.x - from.x + thickness, from.y - to.y + thickness, maze_height};
    return box;
}

}  // namespace

MazeCell beside(MazeCell cell, MazeSide side) {
    switch (side) {
        case MazeSide::east: return {cell.column + 1, cell.row};
        case MazeSide::north: return {cell.column, cell.row + 1};
        case MazeSide::west: return {cell.column - 1, cell.row};
        case MazeSide::south: return {cell.column, cell.row - 1};
    }
    return cell;
}

Maze::Maze(int columns, int rows, bool closed)
    : columns_(columns), rows_(rows), lattice_(static_cast<std::size_t>((2 * columns + 1) * (2 * rows + 1))) {
    for (int line = 0; line <= 2 * rows; ++line) {
        for (int column = 0; column <= 2 * columns; ++column) {
            const bool is_cell = column % 2 == 1 && line % 2 == 1, is_post = column % 2 == 0 && line % 2 == 0;
            const bool is_outside = column == 0 || line == 0 || column == 2 * columns || line == 2 * rows;
            set(column, line, is_post || is_outside || (closed && !is_cell));
        }
    }
}

bool Maze::is_wall(MazeCell cell, MazeSide side) const {
    const MazeCell step = beside({0, 0}, side);
    return stands(2 * cell.column + 1 + step.column, 2 * (rows_ - cell.row) - 1 - step.row);
}

void Maze::set_wall(MazeCell cell, MazeSide side, bool stands) {
    const MazeCell step = beside({0, 0}, side);
    set(2 * cell.column + 1 + step.column, 2 * (rows_ - cell.row) - 1 - step.row, stands);
}

std::vector<MazeCell> Maze::goals() const {
    if (!marked_goals.empty()) return marked_goals;
    std::vector<MazeCell> middle;
    for (int row = (rows_ - 1) / 2; row <= rows_ / 2; ++row) {
        for (int column = (columns_ - 1) / 2; column <= columns_ / 2; ++column) middle.push_back({column, row});
    }
    return middle;
}

MazeSide Maze::start_side() const {
    for (const MazeSide side : {MazeSide::north, MazeSide::east, MazeSide::south, MazeSide::west}) {
        if (!is_wall(start(), side)) return side;
    }
    return MazeSide::north;
}

Maze generate_maze(const MazePlan& plan) {
    Maze maze(plan.columns, plan.rows, true);
    constexpr std::array<MazeSide, 4> order{MazeSide::north, MazeSide::east, MazeSide::south, MazeSide::west};
    std::vector<bool> seen(static_cast<std::size_t>(plan.columns * plan.rows));
    std::mt19937_64 random(static_cast<std::uint64_t>(plan.seed));
    const auto number = [&](MazeCell cell) { return static_cast<std::size_t>(cell.row * plan.columns + cell.column); };
    std::vector<MazeCell> way{{0, 0}};
    seen[0] = true;
    while (!way.empty()) {
        const MazeCell here = way.back();
        std::vector<MazeSide> fresh;
        for (const MazeSide side : order) {
            const MazeCell next = beside(here, side);
            if (maze.has(next) && !seen[number(next)]) fresh.push_back(side);
        }
        if (fresh.empty()) {
            way.pop_back();
            continue;
        }
        // The first step is north if possible. The modulo's bias is below 2^-61.
        const MazeSide side = fresh[way.size() == 1 ? 0 : static_cast<std::size_t>(random() % fresh.size())];
        maze.set_wall(here, side, false);
        way.push_back(beside(here, side));
        seen[number(way.back())] = true;
    }
    return maze;
}

std::vector<BoxSpec> walls_of(const Maze& maze, const MazeSpec& spec) {
    const int columns = 2 * maze.columns() + 1, lines = 2 * maze.rows() + 1;
    const auto place = [&](int column, int line) {
        return Point2D{spec.at.x + (column - 1) * spec.cell / 2, spec.at.y + (lines - 2 - line) * spec.cell / 2};
    };
    std::vector<BoxSpec> walls;
    const auto put = [&](const Point2D& from, const Point2D& to) {
        walls.push_back(wall_between(from, to, spec.thickness));
        walls.back().place = spec.place;
    };
    std::vector<bool> has_wall(static_cast<std::size_t>(columns * lines));
    const auto run = [&](int column, int line, int right, int down) {
        int count = 0;
        while (column + (2 * count + 1) * right < columns && line + (2 * count + 1) * down < lines &&
               maze.stands(column + (2 * count + 1) * right, line + (2 * count + 1) * down))
            ++count;
        for (int i = 0; count > 0 && i <= count; ++i)
            has_wall[static_cast<std::size_t>((line + 2 * i * down) * columns + column + 2 * i * right)] = true;
        if (count > 0) put(place(column, line), place(column + 2 * count * right, line + 2 * count * down));
        return count;
    };
    for (int line = 0; line < lines; line += 2) {
        for (int column = 0; column < columns; column += 2) column += 2 * run(column, line, 1, 0);
    }
    for (int column = 0; column < columns; column += 2) {
        for (int line = 0; line < lines; line += 2) line += 2 * run(column, line, 0, 1);
    }
    for (int line = 0; line < lines; line += 2) {
        for (int column = 0; column < columns; column += 2) {
            if (!has_wall[static_cast<std::size_t>(line * columns + column)] && maze.stands(column, line))
                put(place(column, line), place(column, line));
        }
    }
    return walls;
}

}  // namespace nezumi
