// A drawing is a lattice: posts at even rows and columns, walls between them, cells where both are odd.
#include "engine/world/maze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <utility>

namespace nezumi {
namespace {

// A place in the lattice: columns from the west, rows from the north. Even ones are posts and walls.
struct Lattice {
    explicit Lattice(const std::vector<std::string>& drawn)
        : rows(drawn),
          post(drawn.front().starts_with('o') ? "o" : "+"),
          signs(drawn.front().find(post, 1) == 4 ? 4 : 3) {}

    const std::vector<std::string>& rows;
    const std::string_view post;
    const std::size_t signs;  // of a cell and a post: 3, or 4 as in the drawings that contests exchange

    int columns() const { return static_cast<int>(rows.front().size() / signs) * 2 + 1; }
    int lines() const { return static_cast<int>(rows.size()); }
    // The number of the first letter there, from 0.
    std::size_t first(int column) const {
        return static_cast<std::size_t>(column / 2) * signs + static_cast<std::size_t>(column % 2);
    }
    // The drawn text there: a column of posts has one letter, one between posts the others of the cell.
    std::string_view at(int column, int line) const {
        return std::string_view(rows[static_cast<std::size_t>(line)])
            .substr(first(column), column % 2 == 0 ? 1 : signs - 1);
    }
    bool is_solid(int column, int line) const { return at(column, line).front() != ' '; }
};

// A box from one post's middle to another's, with square ends.
BoxSpec wall_between(const Point2D& from, const Point2D& to) {
    BoxSpec box;
    box.at = {(from.x + to.x) / 2, (from.y + to.y) / 2, maze_height / 2};
    box.size = {to.x - from.x + maze_wall, from.y - to.y + maze_wall, maze_height};
    return box;
}

}  // namespace

std::vector<std::string> draw_maze(const MazePlan& plan) {
    const int columns = plan.columns, lines = 2 * plan.rows + 1;
    std::vector<std::string> rows;
    for (int line = 0; line < lines; ++line) {
        std::string row = line % 2 == 0 ? "+" : "|";
        for (int column = 0; column < columns; ++column) row += line % 2 == 0 ? "--+" : "  |";
        rows.push_back(std::move(row));
    }
    // The place of a cell in the drawing; rows of cells are counted from the south.
    const auto letter = [](int column) { return static_cast<std::size_t>(3 * column + 1); };
    const auto line_of = [&](int row) { return static_cast<std::size_t>(lines - 2 - 2 * row); };

    struct Step {
        int column, row;
    };
    constexpr std::array<Step, 4> steps{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
    std::vector<bool> seen(static_cast<std::size_t>(columns * plan.rows));
    std::mt19937_64 random(static_cast<std::uint64_t>(plan.seed));
    std::vector<Step> way{{0, 0}};
    seen[0] = true;
    while (!way.empty()) {
        const Step here = way.back();
        std::vector<Step> fresh;
        for (const Step& step : steps) {
            const Step next{here.column + step.column, here.row + step.row};
            const bool inside = next.column >= 0 && next.column < columns && next.row >= 0 && next.row < plan.rows;
            if (inside && !seen[static_cast<std::size_t>(next.row * columns + next.column)]) fresh.push_back(step);
        }
        if (fresh.empty()) {
            way.pop_back();
            continue;
        }
        // The first step is north if possible. The modulo's bias is below 2^-61.
        const std::size_t which = way.size() == 1 ? 0 : static_cast<std::size_t>(random() % fresh.size());
        const Step step = fresh[which];
        // A removed wall between two neighbouring cells.
        if (step.column == 0) {
            std::string& line = rows[line_of(here.row) - static_cast<std::size_t>(step.row)];
            line[letter(here.column)] = line[letter(here.column) + 1] = ' ';
        } else {
            const std::size_t at = letter(here.column);
            rows[line_of(here.row)][step.column > 0 ? at + 2 : at - 1] = ' ';
        }
        const Step next{here.column + step.column, here.row + step.row};
        seen[static_cast<std::size_t>(next.row * columns + next.column)] = true;
        way.push_back(next);
    }
    return rows;
}

MazeProblem check_maze(const std::vector<std::string>& rows) {
    constexpr auto most = static_cast<std::size_t>(most_maze_cells);
    if (rows.size() < 3 || rows.size() % 2 == 0 || rows.size() > 2 * most + 1) {
        return {fmt::format("expected 2 rows for each cell and one more, for 1 to {} cells, got {} rows",
                            most_maze_cells, rows.size()),
                0};
    }
    const std::size_t width = rows.front().size();
    const Lattice maze(rows);
    if (width <= maze.signs || width % maze.signs != 1 || width > maze.signs * most + 1) {
        return {fmt::format("expected {} signs for each cell and one more, for 1 to {} cells, got {} signs", maze.signs,
                            most_maze_cells, width),
                1};
    }
    const std::string_view dashes = maze.signs == 4 ? "---" : "--", blanks = maze.signs == 4 ? "   " : "  ";
    for (int line = 0; line < maze.lines(); ++line) {
        const std::size_t number = static_cast<std::size_t>(line) + 1;
        if (const std::size_t got = rows[number - 1].size(); got != width)
            return {fmt::format("expected {} signs, as in the first row, got {}", width, got), number};
        for (int column = 0; column < maze.columns(); ++column) {
            const std::string_view drawn = maze.at(column, line);
            const bool is_post = column % 2 == 0 && line % 2 == 0, is_cell = column % 2 == 1 && line % 2 == 1;
            const std::string_view wall = is_post ? maze.post : is_cell ? blanks : line % 2 == 0 ? dashes : "|";
            // A start or goal is marked by one letter.
            const auto is_mark = [](char c) { return c == 'S' || c == 'G'; };
            const bool is_marked = is_cell && std::count_if(drawn.begin(), drawn.end(), is_mark) == 1 &&
                                   drawn.find_first_not_of(" SG") == std::string_view::npos;
            if (drawn != wall && !is_marked && drawn.find_first_not_of(' ') != std::string_view::npos)
                return {fmt::format("expected \"{}\"{} from sign {} on, got \"{}\"", wall, is_cell ? "" : " or blanks",
                                    maze.first(column) + 1, drawn),
                        number};
        }
    }
    return {};
}

std::vector<BoxSpec> walls_of(const std::vector<std::string>& rows, double cell, const Point2D& at) {
    const Lattice maze(rows);
    const int columns = maze.columns(), lines = maze.lines();
    const auto place = [&](int column, int line) {
        return Point2D{at.x + (column - 1) * cell / 2, at.y + (lines - 2 - line) * cell / 2};
    };
    std::vector<BoxSpec> walls;
    std::vector<bool> has_wall(static_cast<std::size_t>(columns * lines));
    const auto run = [&](int column, int line, int right, int down) {
        int count = 0;
        while (column + (2 * count + 1) * right < columns && line + (2 * count + 1) * down < lines &&
               maze.is_solid(column + (2 * count + 1) * right, line + (2 * count + 1) * down))
            ++count;
        for (int i = 0; count > 0 && i <= count; ++i)
            has_wall[static_cast<std::size_t>((line + 2 * i * down) * columns + column + 2 * i * right)] = true;
        if (count > 0)
            walls.push_back(
                wall_between(place(column, line), place(column + 2 * count * right, line + 2 * count * down)));
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
            if (!has_wall[static_cast<std::size_t>(line * columns + column)] && maze.is_solid(column, line))
                walls.push_back(wall_between(place(column, line), place(column, line)));
        }
    }
    return walls;
}

}  // namespace nezumi
