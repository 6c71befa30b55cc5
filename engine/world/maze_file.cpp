// The content tells the format: bytes that are not text, lines of six numbers, or a drawing.
#include "engine/world/maze_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/number_in.hpp"

namespace nezumi {
namespace {

constexpr int maz_cells = 16;  // along a side
constexpr std::string_view separators = " \t\r,;";
constexpr std::array<MazeSide, 4> written_sides{MazeSide::north, MazeSide::east, MazeSide::south, MazeSide::west};
constexpr std::array<std::string_view, 4> side_names{"east", "north", "west", "south"};

struct Line {
    std::string text;
    int number;
};

std::vector<Line> lines_of(std::string_view content) {
    if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);
    std::vector<Line> lines;
    std::string text;
    const auto end = [&] { lines.push_back({std::exchange(text, ""), static_cast<int>(lines.size()) + 1}); };
    for (std::size_t i = 0; i < content.size(); ++i) {
        const bool is_cr = content[i] == '\r';
        if (!is_cr && content[i] != '\n') text += content[i];
        if (is_cr && i + 1 < content.size() && content[i + 1] == '\n') continue;
        if (is_cr || content[i] == '\n') end();
    }
    if (!text.empty()) end();
    return lines;
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(separators); at < line.size();) {
        const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(separators, end);
    }
    return words;
}

std::optional<std::array<int, 6>> numbers_of(std::string_view line) {
    const auto words = words_of(line);
    std::array<int, 6> numbers{};
    if (words.size() != numbers.size()) return std::nullopt;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto number = number_in<int>(words[i]);
        if (!number) return std::nullopt;
        numbers[i] = *number;
    }
    return numbers;
}

// The walls of each cell, in the order of `written_sides`.
using CellWalls = std::map<std::pair<int, int>, std::array<bool, 4>>;

// Makes a maze. Each wall between two cells is given twice, once for each cell: an error if the two differ.
tl::expected<Maze, std::string> maze_of(const CellWalls& walls, int columns, int rows) {
    Maze maze(columns, rows, false);
    for (const auto& [place, stands] : walls) {
        const MazeCell cell{place.first, place.second};
        for (std::size_t i = 0; i < written_sides.size(); ++i) {
            const MazeCell other = beside(cell, written_sides[i]);
            if (maze.has(other) && walls.at({other.column, other.row})[(i + 2) % 4] != stands[i]) {
                return tl::unexpected(fmt::format("cell {} {} has {} wall in the {}, which cell {} {} contradicts",
                                                  cell.column, cell.row, stands[i] ? "a" : "no",
                                                  side_names[static_cast<std::size_t>(written_sides[i])], other.column,
                                                  other.row));
            }
            maze.set_wall(cell, written_sides[i], stands[i]);
        }
    }
    return maze;
}

Expected<Maze> read_bytes(std::string_view content, const std::string& file) {
    const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(content.size()))));
    if (static_cast<std::size_t>(side * side) != content.size() || side > most_maze_cells) {
        return failure(
            fmt::format("expected a drawing of a maze, or a byte for each cell of a square maze, such as 256 "
                        "bytes for 16 x 16 cells (a .maz file), got {} bytes that are not text",
                        content.size()),
            {file, 0});
    }
    // Tries the order column by column, then row by row: in the wrong order, the walls of neighbours contradict.
    std::string problem;
    for (const bool rows_first : {false, true}) {
        CellWalls walls;
        for (int i = 0; i < side * side; ++i) {
            const auto bits = static_cast<unsigned char>(content[static_cast<std::size_t>(i)]);
            const std::pair<int, int> place =
                rows_first ? std::pair(i % side, i / side) : std::pair(i / side, i % side);
            for (std::size_t bit = 0; bit < 4; ++bit) walls[place][bit] = (bits >> bit & 1) != 0;
        }
        auto maze = maze_of(walls, side, side);
        if (maze) return *maze;
        if (problem.empty()) problem = maze.error();
    }
    return failure(problem, {file, 0});
}

Expected<Maze> read_numbers(const std::vector<Line>& lines, const std::string& file) {
    CellWalls walls;
    int columns = 0, rows = 0;
    for (const Line& line : lines) {
        if (words_of(line.text).empty()) continue;
        const auto numbers = numbers_of(line.text);
        const auto in = [&](std::size_t i, int most) { return (*numbers)[i] >= 0 && (*numbers)[i] <= most; };
        const bool fits = numbers && in(0, most_maze_cells - 1) && in(1, most_maze_cells - 1) && in(2, 1) && in(3, 1) &&
                          in(4, 1) && in(5, 1);
        if (!fits) {
            return failure(
                fmt::format("expected \"X Y N E S W\", a cell from 0 0 to {0} {0} and 1 for each wall, got \"{1}\"",
                            most_maze_cells - 1, shown(line.text)),
                {file, line.number});
        }
        auto& cell = walls[{(*numbers)[0], (*numbers)[1]}];
        for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = (*numbers)[i + 2] == 1;
        columns = std::max(columns, (*numbers)[0] + 1);
        rows = std::max(rows, (*numbers)[1] + 1);
    }
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            if (!walls.contains({column, row}))
                return failure(fmt::format("expected a line for cell {} {}, got none", column, row), {file, 0});
        }
    }
    auto maze = maze_of(walls, columns, rows);
    if (!maze) return failure(maze.error(), {file, 0});
    return *maze;
}

// Whether a line can be a row of a drawing, not a title or a comment.
bool is_drawn(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return false;
    line.remove_prefix(first);
    const char sign = line.front();
    if (sign == '|' || line.starts_with("---")) return true;
    return std::string_view("oO+.*").find(sign) != std::string_view::npos &&
           (line.size() == 1 || std::string_view("-=_ \t").find(line[1]) != std::string_view::npos);
}

Expected<Maze> read_drawn(const std::vector<Line>& lines, const std::string& file) {
    const auto drawn = [](const Line& line) { return is_drawn(line.text); };
    const auto begin = std::find_if(lines.begin(), lines.end(), drawn);
    if (begin == lines.end()) {
        return failure(lines.empty() ? "expected a drawing of a maze, got an empty file"
                                     : "expected a drawing of a maze, whose rows begin with a post as in \"o---o\" or "
                                       "with \"|\"",
                       {file, 0});
    }
    // Empty rows and rows that begin with a blank are part of the drawing if a drawn row follows.
    auto end = begin + 1;
    for (auto at = begin + 1; at != lines.end(); ++at) {
        const bool is_open =
            at->text.empty() || std::string_view(" \t\r").find(at->text.front()) != std::string_view::npos;
        if (drawn(*at)) {
            end = at + 1;
        } else if (!is_open) {
            break;
        }
    }
    std::vector<std::string> rows;
    for (auto at = begin; at != end; ++at) rows.push_back(at->text);
    auto maze = read_drawing(std::move(rows));
    if (!maze) {
        const MazeProblem& problem = maze.error();
        return failure(problem.text, {file, problem.row == 0 ? 0 : begin->number + static_cast<int>(problem.row) - 1});
    }
    return *maze;
}

}  // namespace

Expected<Maze> read_maze(std::string_view content, const std::string& file) {
    const auto is_no_text = [](char sign) {
        return sign >= 0 && sign < ' ' && sign != '\t' && sign != '\n' && sign != '\r';
    };
    if (std::any_of(content.begin(), content.end(), is_no_text)) return read_bytes(content, file);
    const std::vector<Line> lines = lines_of(content);
    const auto first =
        std::find_if(lines.begin(), lines.end(), [](const Line& line) { return !words_of(line.text).empty(); });
    if (first != lines.end() && numbers_of(first->text)) return read_numbers(lines, file);
    return read_drawn(lines, file);
}

Expected<std::string> write_maze(const Maze& maze, MazeFormat format) {
    std::string text;
    if (format == MazeFormat::contest || format == MazeFormat::map) {
        for (const std::string& row : draw_maze(maze, format == MazeFormat::map ? '+' : 'o')) text += row + '\n';
        return text;
    }
    if (format == MazeFormat::maz && (maze.columns() != maz_cells || maze.rows() != maz_cells)) {
        return failure(
            fmt::format("a .maz file holds {0} x {0} cells, and this maze has {1} x {2}: write .txt, .map or .num",
                        maz_cells, maze.columns(), maze.rows()));
    }
    for (int column = 0; column < maze.columns(); ++column) {
        for (int row = 0; row < maze.rows(); ++row) {
            if (format == MazeFormat::num) text += fmt::format("{} {}", column, row);
            unsigned bits = 0;
            for (std::size_t i = 0; i < written_sides.size(); ++i) {
                const bool stands = maze.is_wall({column, row}, written_sides[i]);
                bits |= (stands ? 1U : 0U) << i;
                if (format == MazeFormat::num) text += stands ? " 1" : " 0";
            }
            text += format == MazeFormat::num ? '\n' : static_cast<char>(bits);
        }
    }
    return text;
}

}  // namespace nezumi
