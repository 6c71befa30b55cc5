// Mazes: what is drawn stands, and what is made from a seed is a maze.
#include <algorithm>
#include <catch2/catch.hpp>
#include <queue>

#include "engine/world/maze.hpp"

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
Walk walk(const std::vector<std::string>& rows, int columns, int lines) {
    const auto open = [&](int column, int row, int right, int up) {
        const int letter = 3 * column + 1 + (right == 0 ? 0 : right > 0 ? 2 : -1);
        const int line = 2 * (lines - row) - 1 - up;
        return rows[static_cast<std::size_t>(line)][static_cast<std::size_t>(letter)] == ' ';
    };
    Walk found;
    std::vector<bool> seen(static_cast<std::size_t>(columns * lines));
    std::queue<std::pair<int, int>> next;
    next.emplace(0, 0);
    seen[0] = true;
    while (!next.empty()) {
        const auto [column, row] = next.front();
        next.pop();
        ++found.reached;
        for (const auto& [right, up] : {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
            if (!open(column, row, right, up)) continue;
            if (right + up > 0) ++found.openings;
            const auto index = static_cast<std::size_t>((row + up) * columns + column + right);
            if (!seen[index]) next.emplace(column + right, row + up);
            seen[index] = true;
        }
    }
    return found;
}

bool is_wall(const BoxSpec& box, Point2D middle, double length_x, double length_y) {
    return box.at.x == Approx(middle.x) && box.at.y == Approx(middle.y) && box.size.x == Approx(length_x) &&
           box.size.y == Approx(length_y) && box.at.z == Approx(0.025) && box.size.z == Approx(0.05);
}

}  // namespace

TEST_CASE("the drawings that contests exchange have posts o, four signs a cell, and letters for start and goal",
          "[engine][maze]") {
    const std::vector<std::string> contest{
        "o---o---o",  //
        "|     G |",  //
        "o   o   o",  //
        "| S |   |",  //
        "o---o---o",
    };
    CHECK(check_maze(contest).text.empty());
    const auto walls = walls_of(contest, 0.18, {0, 0}), same = walls_of(small, 0.18, {0, 0});
    REQUIRE(walls.size() == same.size());
    for (std::size_t i = 0; i < walls.size(); ++i) {
        CHECK(walls[i].at.x == same[i].at.x);
        CHECK(walls[i].at.y == same[i].at.y);
    }
    std::vector<std::string> wrong = contest;
    wrong[3] = "| x |   |";
    CHECK(check_maze(wrong).text == "expected \"   \" from sign 2 on, got \" x \"");
    wrong = contest;
    wrong[0] = "o---o---";
    CHECK(check_maze(wrong).text == "expected 4 signs for each cell and one more, for 1 to 64 cells, got 8 signs");
}

TEST_CASE("the walls of a drawing stand between the cells, one box for each line", "[engine][maze]") {
    REQUIRE(check_maze(small).text.empty());
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
    REQUIRE(check_maze(open).text.empty());
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
            const auto drawn = draw_maze({columns, rows, seed});
            REQUIRE(check_maze(drawn).text.empty());
            const Walk found = walk(drawn, columns, rows);
            CHECK(found.reached == columns * rows);
            CHECK(found.openings == columns * rows - 1);
            if (rows > 1) CHECK(drawn[drawn.size() - 2].substr(0, 4) == "|  |");
            if (rows > 1) CHECK(drawn[drawn.size() - 3].substr(0, 3) == "+  ");
        }
    }
    CHECK(draw_maze({8, 8, 1}) == draw_maze({8, 8, 1}));
    CHECK(draw_maze({8, 8, 1}) != draw_maze({8, 8, 2}));
}

TEST_CASE("a drawing that is none is told with its row", "[engine][maze]") {
    const auto problem = [](std::vector<std::string> rows) {
        const MazeProblem found = check_maze(rows);
        return std::to_string(found.row) + " " + found.text;
    };
    CHECK(problem({}) == "0 expected 2 rows for each cell and one more, for 1 to 64 cells, got 0 rows");
    CHECK(problem({"+--+", "|  |"}) == "0 expected 2 rows for each cell and one more, for 1 to 64 cells, got 2 rows");
    CHECK(problem({"+--", "|  ", "+--"}) ==
          "1 expected 3 signs for each cell and one more, for 1 to 64 cells, got 3 signs");
    CHECK(problem({"+--+", "|   |", "+--+"}) == "2 expected 4 signs, as in the first row, got 5");
    CHECK(problem({"+--+", "|  |", "+- +"}) == "3 expected \"--\" or blanks from sign 2 on, got \"- \"");
    CHECK(problem({"+--+", "|x |", "+--+"}) == "2 expected \"  \" from sign 2 on, got \"x \"");
    CHECK(problem({"+--o", "|  |", "+--+"}) == "1 expected \"+\" or blanks from sign 4 on, got \"o\"");
    CHECK(problem({"+--+", "I  |", "+--+"}) == "2 expected \"|\" or blanks from sign 1 on, got \"I\"");
}
