// Mazes as drawings in text: reads those of contests, with any posts and line ends, and writes them.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/world/maze.hpp"

namespace nezumi {
namespace {

constexpr std::size_t usual_characters = 3;       // width of a cell with one post, if the first row does not show it
constexpr std::size_t contest_characters = 4;     // the same in drawings of contests
constexpr std::string_view walls_across = "-=_";  // a horizontal wall consists of one of these

// Removes a byte order mark, CR, blanks at the end and the common indentation, and replaces tabs by blanks.
void tidy(std::vector<std::string>& rows) {
    if (!rows.empty() && rows.front().starts_with("\xef\xbb\xbf")) rows.front().erase(0, 3);
    std::size_t indented = std::string::npos;
    for (std::string& row : rows) {
        std::string wide;
        for (const char sign : row) {
            if (sign != '\t') wide += sign;
            if (sign == '\t') wide.resize((wide.size() / contest_characters + 1) * contest_characters, ' ');
        }
        const std::size_t last = wide.find_last_not_of(" \r");
        wide.resize(last == std::string::npos ? 0 : last + 1);
        if (!wide.empty()) indented = std::min(indented, wide.find_first_not_of(' '));
        row = std::move(wide);
    }
    for (std::string& row : rows) row.erase(0, std::min(indented, row.size()));
}

// A drawing of a maze. `characters` is the number of characters for one cell together with one post.
class Drawing {
public:
    Drawing(const std::vector<std::string>& rows, std::size_t characters, char post)
        : rows_(rows), characters_(characters), post_(post) {
        width_ = rows.front().size();
        // If posts are blanks, the last post of the first row is missing: the longest row gives the width.
        if (post == ' ') {
            for (const std::string& row : rows) width_ = std::max(width_, row.size());
        }
    }

    tl::expected<Maze, MazeProblem> read() const {
        constexpr auto most = static_cast<std::size_t>(most_maze_cells);
        if (width_ <= characters_ || width_ % characters_ != 1 || width_ > characters_ * most + 1) {
            return wrong(1, fmt::format("expected {} characters for each cell and one more, for 1 to {} cells, got {}",
                                        characters_, most_maze_cells, width_));
        }
        Maze maze(static_cast<int>(width_ / characters_), static_cast<int>(rows_.size() / 2), false);
        for (int line = 0; line <= 2 * maze.rows(); ++line) {
            const std::size_t number = static_cast<std::size_t>(line) + 1;
            std::string row = rows_[number - 1];
            if (row.size() > width_) {
                return wrong(number,
                             fmt::format("expected {} characters, as in the first row, got {}", width_, row.size()));
            }
            row.resize(width_, ' ');
            for (int column = 0; column <= 2 * maze.columns(); ++column) {
                const std::size_t first =
                    static_cast<std::size_t>(column / 2) * characters_ + (column % 2 == 1 ? 1 : 0);
                const std::string_view drawn =
                    std::string_view(row).substr(first, column % 2 == 1 ? characters_ - 1 : 1);
                const bool is_blank = drawn.find_first_not_of(' ') == std::string_view::npos;
                const bool fits = column % 2 == 1 && line % 2 == 1 ? is_cell(drawn)
                                  : column % 2 == 0 && line % 2 == 0
                                      ? is_post(drawn.front())
                                      : (line % 2 == 0 ? is_across(drawn) : drawn == "|");
                if (!is_blank && !fits) {
                    return wrong(number, fmt::format("expected {} from character {} on, got \"{}\"",
                                                     expected(column, line), first + 1, drawn));
                }
                if (column % 2 == 1 && line % 2 == 1) {
                    mark(maze, drawn, {column / 2, maze.rows() - 1 - line / 2});
                } else {
                    // In a drawing with blank posts, each blank in place of a post is a post.
                    maze.set(column, line, !is_blank || (post_ == ' ' && column % 2 == 0 && line % 2 == 0));
                }
            }
        }
        std::stable_sort(maze.marked_goals.begin(), maze.marked_goals.end(),
                         [](MazeCell a, MazeCell b) { return a.row < b.row; });
        return maze;
    }

private:
    static tl::unexpected<MazeProblem> wrong(std::size_t row, std::string text) {
        return tl::unexpected(MazeProblem{std::move(text), row});
    }
    std::string expected(int column, int line) const {
        if (column % 2 == 1 && line % 2 == 1) return fmt::format("\"{}\"", std::string(characters_ - 1, ' '));
        if (column % 2 == 0 && line % 2 == 0) return fmt::format("\"{}\" or blanks", post_);
        return fmt::format("\"{}\" or blanks", line % 2 == 0 ? std::string(characters_ - 1, '-') : "|");
    }
    bool is_post(char sign) const { return sign == post_ || sign == '-' || sign == '|'; }
    // Whether these characters are a horizontal wall: as wide as the cell, or shorter in the middle.
    bool is_across(std::string_view drawn) const {
        const char sign = drawn[drawn.size() / 2];
        const auto end = drawn.find_last_not_of(' '), begin = drawn.find_first_not_of(' ');
        return walls_across.find(sign) != std::string_view::npos &&
               drawn.substr(begin, end + 1 - begin).find_first_not_of(sign) == std::string_view::npos &&
               begin == drawn.size() - 1 - end;
    }
    static bool is_cell(std::string_view drawn) {
        return std::all_of(drawn.begin(), drawn.end(), [](unsigned char sign) {
            return sign == ' ' || std::isalnum(sign) != 0 ||
                   std::string_view("*.@<>^").find(static_cast<char>(sign)) != std::string_view::npos;
        });
    }
    static void mark(Maze& maze, std::string_view drawn, MazeCell cell) {
        if (drawn.find_first_of("Ss") != std::string_view::npos && !maze.marked_start) maze.marked_start = cell;
        if (drawn.find_first_of("Gg") != std::string_view::npos) maze.marked_goals.push_back(cell);
    }

    const std::vector<std::string>& rows_;
    std::size_t characters_;
    char post_;
    std::size_t width_;
};

}  // namespace

tl::expected<Maze, MazeProblem> read_drawing(std::vector<std::string> rows) {
    constexpr auto most = static_cast<std::size_t>(most_maze_cells);
    tidy(rows);
    if (rows.size() < 3 || rows.size() % 2 == 0 || rows.size() > 2 * most + 1) {
        return tl::unexpected(
            MazeProblem{fmt::format("expected 2 rows for each cell and one more, for 1 to {} cells, got {} rows",
                                    most_maze_cells, rows.size())});
    }
    const std::string& first = rows.front();
    const bool draws_posts = !first.empty() && first.front() != ' ' && first.front() != '-';
    if (draws_posts) {
        const std::size_t second = first.find(first.front(), 1);
        const bool tells = second != std::string::npos && second >= 2;
        return Drawing(rows, tells ? second : usual_characters, first.front()).read();
    }
    // Blank posts do not show the width of a cell: tries 4, 3 and 2 characters.
    auto read = Drawing(rows, contest_characters, ' ').read();
    for (const std::size_t characters : {usual_characters, std::size_t{2}}) {
        if (read) break;
        if (auto other = Drawing(rows, characters, ' ').read()) read = std::move(other);
    }
    return read;
}

std::vector<std::string> draw_maze(const Maze& maze, char post) {
    const std::vector<MazeCell>& goals = maze.marked_goals;
    std::vector<std::string> rows;
    for (int line = 0; line <= 2 * maze.rows(); ++line) {
        std::string row;
        for (int column = 0; column <= 2 * maze.columns(); ++column) {
            const MazeCell cell{column / 2, maze.rows() - 1 - line / 2};
            if (column % 2 == 1 && line % 2 == 1) {
                row += maze.marked_start == cell ? " S " : contains(goals, cell) ? " G " : "   ";
            } else if (!maze.stands(column, line)) {
                row += column % 2 == 0 ? " " : "   ";
            } else if (line % 2 == 0) {
                row += column % 2 == 0 ? std::string(1, post) : "---";
            } else {
                row += '|';
            }
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace nezumi
