// Mazes: what is drawn stands, and what is made from a seed is a maze.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "engine/world/maze.hpp"
#include "engine/world/maze_way.hpp"

using namespace nezumi;

namespace {

const std::vector<std::string> small{
    "+--+--+",  //
    "|     |",  //
    "+  +  +",  //
    "|  |  |",  //
    "+--+--+",
};

// How many openings lie within a maze, and how many cells can be reached from the south-west one.
struct Walk {
    int openings = 0, reached = 0;
};
Walk walk(const Maze& maze) {
    Walk found{.reached = reachable_cells(maze)};
    for (int column = 0; column < maze.columns(); ++column) {
        for (int row = 0; row < maze.rows(); ++row) {
            for (const MazeSide side : {MazeSide::east, MazeSide::north})
                found.openings += maze.is_wall({column, row}, side) ? 0 : 1;
        }
    }
    return found;
}

Maze maze_of(const std::vector<std::string>& rows) {
    const auto maze = read_drawing(rows);
    INFO((maze ? "" : maze.error().text));
    REQUIRE(maze);
    return *maze;
}

std::vector<BoxSpec> walls_of(const std::vector<std::string>& rows, double cell, const Point2D& at) {
    return nezumi::walls_of(maze_of(rows), {.cell = cell, .at = at});
}

std::string problem_of(std::vector<std::string> rows) {
    const auto maze = read_drawing(std::move(rows));
    return maze ? "" : std::to_string(maze.error().row) + " " + maze.error().text;
}

bool is_wall(const BoxSpec& box, Point2D middle, double length_x, double length_y) {
    return box.at.x == Approx(middle.x) && box.at.y == Approx(middle.y) && box.size.x == Approx(length_x) &&
           box.size.y == Approx(length_y) && box.at.z == Approx(0.025) && box.size.z == Approx(0.05);
}

}  // namespace

TEST_CASE("the drawings that contests exchange have posts o, four characters a cell, and letters for start and goal",
          "[engine][maze]") {
    const std::vector<std::string> contest{
        "o---o---o",  //
        "|     G |",  //
        "o   o   o",  //
        "| S |   |",  //
        "o---o---o",
    };
    const Maze maze = maze_of(contest);
    CHECK(maze.start() == MazeCell{0, 0});
    CHECK(maze.goals() == std::vector<MazeCell>{{1, 1}});
    CHECK(draw_maze(maze) == contest);
    const auto walls = walls_of(contest, 0.18, {0, 0}), same = walls_of(small, 0.18, {0, 0});
    REQUIRE(walls.size() == same.size());
    for (std::size_t i = 0; i < walls.size(); ++i) {
        CHECK(walls[i].at.x == same[i].at.x);
        CHECK(walls[i].at.y == same[i].at.y);
    }
    std::vector<std::string> wrong = contest;
    wrong[3] = "| # |   |";
    CHECK(problem_of(wrong) == "4 expected \"   \" from character 2 on, got \" # \"");
    wrong = contest;
    wrong[0] = "o---o---";
    CHECK(problem_of(wrong) == "1 expected 4 characters for each cell and one more, for 1 to 64 cells, got 8");
}

TEST_CASE("drawings vary as the programs that write them do", "[engine][maze]") {
    const Maze maze = maze_of({"o---o---o", "|     G |", "o   o   o", "| S |   |", "o---o---o"});
    CHECK(maze_of({"\xef\xbb\xbfo---o---o\r", "|     G |\r", "o   o   o\r", "| S |   |\r", "o---o---o\r"}) == maze);
    CHECK(maze_of({"  +---+---+  ", "  |     g |", "  +   +   +", "  | s |   |   ", "  +---+---+"}) == maze);
    CHECK(maze_of({"o---o---o", "|\t  G |", "o\to\to", "| S |\t|", "o---o---o"}) == maze);
    CHECK(maze_of({"+-+-+", "|  G|", "+ + +", "|S| |", "+-+-+"}) == maze);
    CHECK(maze_of({"*===*===*", "|     G |", "*   *   *", "| S | 7 |", "*===*===*"}) == maze);
    CHECK(maze_of({"+ - + - +", "|     G |", "+   +   +", "| S |   |", "+ - + - +"}) == maze);
    // Blank posts stand as well; the first row does not reach to the last one.
    CHECK(maze_of({" --- ---", "|     G |", "         ", "| S |   |", " --- ---"}) == maze);
    CHECK(maze_of({"---------", "|     G |", "", "| S |   |", "---------"}) == maze);
    const Maze wide = maze_of({"+-----+-----+", "|  S     G  |", "+-----+-----+"});
    CHECK(wide.columns() == 2);
    CHECK(wide.rows() == 1);
    CHECK(wide.start_side() == MazeSide::east);
}

TEST_CASE("a maze without marks begins in the south-west and ends in the middle", "[engine][maze]") {
    CHECK(Maze(4, 4, false).goals() == std::vector<MazeCell>{{1, 1}, {2, 1}, {1, 2}, {2, 2}});
    CHECK(Maze(5, 4, false).goals() == std::vector<MazeCell>{{2, 1}, {2, 2}});
    CHECK(Maze(5, 3, false).goals() == std::vector<MazeCell>{{2, 1}});
    CHECK(Maze(5, 3, false).start() == MazeCell{0, 0});
    const Maze two = maze_of({"o---o---o", "| G   G |", "o---o---o"});
    CHECK(two.goals() == std::vector<MazeCell>{{0, 0}, {1, 0}});
}

TEST_CASE("the shortest way has the fewest cells, then the fewest turns", "[engine][maze]") {
    const Maze open = maze_of({"o---o---o---o", "|         G |", "o   o   o   o", "|           |", "o   o   o   o",
                               "| S         |", "o---o---o---o"});
    const std::vector<MazeCell> way = shortest_way(open);
    CHECK(way == std::vector<MazeCell>{{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}});
    CHECK(shortest_way(maze_of({"o---o---o", "| S | G |", "o---o---o"})).empty());
    CHECK(reachable_cells(maze_of({"o---o---o", "| S | G |", "o---o---o"})) == 1);
}

TEST_CASE("a half-size maze has thinner walls", "[engine][maze]") {
    const auto walls = nezumi::walls_of(maze_of({"o---o", "|   |", "o---o"}), {.cell = 0.09, .thickness = 0.006});
    CHECK(is_wall(walls.front(), {0.0, 0.045}, 0.096, 0.006));
}

TEST_CASE("the walls of a drawing stand between the cells, one box for each line", "[engine][maze]") {
    const auto walls = walls_of(small, 0.18, {0, 0});
    REQUIRE(walls.size() == 5);
    CHECK(is_wall(walls[0], {0.09, 0.27}, 0.372, 0.012));   // north
    CHECK(is_wall(walls[1], {0.09, -0.09}, 0.372, 0.012));  // south
    CHECK(is_wall(walls[2], {-0.09, 0.09}, 0.012, 0.372));  // west
    CHECK(is_wall(walls[3], {0.09, 0.0}, 0.012, 0.192));    // between the southern cells
    CHECK(is_wall(walls[4], {0.27, 0.09}, 0.012, 0.372));   // east
}

TEST_CASE("a post without walls stands alone, and an opening in a line parts it", "[engine][maze]") {
    const std::vector<std::string> open{"+--+  +--+", "|        |", "+  +     +", "|        |", "+--+--+--+"};
    const auto walls = walls_of(open, 0.2, {1, 2});
    REQUIRE(walls.size() == 6);
    CHECK(is_wall(walls[0], {1.0, 2.3}, 0.212, 0.012));
    CHECK(is_wall(walls[1], {1.4, 2.3}, 0.212, 0.012));
    CHECK(is_wall(walls[5], {1.1, 2.1}, 0.012, 0.012));
}

TEST_CASE("a maze that is made has one way between any two cells, and leads north first", "[engine][maze]") {
    for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(2, 5), std::pair(16, 16), std::pair(64, 3)}) {
        for (const std::int64_t seed : {0, 1, 2, 999}) {
            CAPTURE(columns, rows, seed);
            const Maze maze = generate_maze({columns, rows, seed});
            const Walk found = walk(maze);
            CHECK(found.reached == columns * rows);
            CHECK(found.openings == columns * rows - 1);
            CHECK(maze_of(draw_maze(maze)) == maze);
            if (rows > 1) CHECK(maze.start_side() == MazeSide::north);
            if (columns > 1 && rows > 1) CHECK(maze.is_wall({0, 0}, MazeSide::east));
        }
    }
    CHECK(generate_maze({8, 8, 1}) == generate_maze({8, 8, 1}));
    CHECK(generate_maze({8, 8, 1}) != generate_maze({8, 8, 2}));
}

TEST_CASE("an error in the drawing of a maze has its row", "[engine][maze]") {
    CHECK(problem_of({}) == "0 expected 2 rows for each cell and one more, for 1 to 64 cells, got 0 rows");
    CHECK(problem_of({"+--+", "|  |"}) ==
          "0 expected 2 rows for each cell and one more, for 1 to 64 cells, got 2 rows");
    CHECK(problem_of({"+--", "|  ", "+--"}) ==
          "1 expected 3 characters for each cell and one more, for 1 to 64 cells, got 3");
    CHECK(problem_of({"+--+", "|   |", "+--+"}) == "2 expected 4 characters, as in the first row, got 5");
    CHECK(problem_of({"+--+", "|  |", "+- +"}) == "3 expected \"--\" or blanks from character 2 on, got \"- \"");
    CHECK(problem_of({"+--+", "|- |", "+--+"}) == "2 expected \"  \" from character 2 on, got \"- \"");
    CHECK(problem_of({"+--o", "|  |", "+--+"}) == "1 expected \"+\" or blanks from character 4 on, got \"o\"");
    CHECK(problem_of({"+--+", "I  |", "+--+"}) == "2 expected \"|\" or blanks from character 1 on, got \"I\"");
}
