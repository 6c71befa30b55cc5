// Files of mazes: drawings, bytes and numbers are read, whatever surrounds them, and written again.
#include <catch2/catch.hpp>
#include <string>

#include "engine/world/maze_file.hpp"

using namespace nezumi;

namespace {

const std::string drawing =
    "o---o---o\n"
    "|     G |\n"
    "o   o   o\n"
    "| S |   |\n"
    "o---o---o\n";

std::string error_of(const std::string& content) {
    const auto maze = read_maze(content, "m.txt");
    return maze ? "" : describe(maze.error());
}

Maze maze_of(const std::string& content) {
    INFO(error_of(content));
    REQUIRE(error_of(content).empty());
    return *read_maze(content, "m.txt");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

}  // namespace

TEST_CASE("a drawing is read with the text around it, and with any line endings", "[engine][maze_file]") {
    const Maze maze = maze_of(drawing);
    CHECK(maze.marked_start == MazeCell{0, 0});
    CHECK(maze_of(drawing.substr(0, drawing.size() - 1)) == maze);
    CHECK(maze_of(replaced(drawing, "\n", "\r\n")) == maze);
    CHECK(maze_of(replaced(drawing, "\n", "\r")) == maze);
    CHECK(maze_of("\xef\xbb\xbf" + drawing) == maze);
    CHECK(maze_of("\n\n" + drawing + "\n \n\n") == maze);
    CHECK(maze_of("APEC-2017, classic\n# 16 x 16\n\n" + drawing + "\ngoal: G, start: S\n") == maze);
    CHECK(maze_of(replaced(drawing, "\n", "   \n")) == maze);
    CHECK(maze_of(replaced(drawing, "o", "+")) == maze);
}

TEST_CASE("a maze of 16 x 16 cells is 256 bytes, columns first", "[engine][maze_file]") {
    Maze maze(16, 16, false);
    maze.set_wall({0, 0}, MazeSide::east, true);
    maze.set_wall({3, 7}, MazeSide::north, true);
    const auto bytes = write_maze(maze, MazeFormat::maz);
    REQUIRE(bytes);
    REQUIRE(bytes->size() == 256);
    CHECK((*bytes)[0] == 2 + 4 + 8);
    CHECK((*bytes)[3 * 16 + 7] == 1);
    CHECK((*bytes)[3 * 16 + 8] == 4);
    CHECK(maze_of(*bytes) == maze);
    // Rows first: only so do the walls of neighbours agree.
    std::string turned = *bytes;
    for (std::size_t x = 0; x < 16; ++x) {
        for (std::size_t y = 0; y < 16; ++y) turned[y * 16 + x] = (*bytes)[x * 16 + y];
    }
    CHECK(maze_of(turned) == maze);
    std::string wrong = *bytes;
    wrong[3 * 16 + 8] = 0;
    CHECK(error_of(wrong) == "m.txt: cell 3 7 has a wall in the north, which cell 3 8 contradicts");
    CHECK(error_of(std::string(255, '\1')) ==
          "m.txt: expected a drawing of a maze, or a byte for each cell of a square maze, such as 256 bytes for "
          "16 x 16 cells (a .maz file), got 255 bytes that are not text");
    CHECK(maze_of(std::string(1, '\x0f')).columns() == 1);
    CHECK(write_maze(Maze(4, 4, false), MazeFormat::maz).error().message ==
          "a .maz file holds 16 x 16 cells, and this maze has 4 x 4: write .txt, .map or .num");
}

TEST_CASE("a maze is a line of numbers for each cell", "[engine][maze_file]") {
    const std::string numbers = "0 0 0 1 1 1\n0 1 1 0 0 1\n1 0 0 1 1 1\n1 1 1 1 0 0\n";
    Maze maze = maze_of(drawing);
    maze.marked_start.reset();
    maze.marked_goals.clear();
    CHECK(maze_of(numbers) == maze);
    CHECK(maze_of(replaced(replaced(numbers, " ", ","), "\n", "\r\n") + "\r\n") == maze);
    CHECK(write_maze(maze, MazeFormat::num).value() == numbers);
    CHECK(error_of("0 0 0 1 1 1\n0 1 1 0 0\n") ==
          "m.txt:2: expected \"X Y N E S W\", a cell from 0 0 to 63 63 and 1 for each wall, got \"0 1 1 0 0\"");
    CHECK(error_of("0 0 0 1 1 2\n").find("m.txt:1: expected \"X Y N E S W\"") == 0);
    CHECK(error_of("64 0 0 1 1 1\n").find("m.txt:1: expected \"X Y N E S W\"") == 0);
    CHECK(error_of("0 0 0 1 1 1\n1 1 1 1 0 0\n") == "m.txt: expected a line for cell 0 1, got none");
    CHECK(error_of(replaced(numbers, "1 0 0 1 1 1", "1 0 0 1 1 0")) ==
          "m.txt: cell 0 0 has a wall in the east, which cell 1 0 contradicts");
}

TEST_CASE("every format gives the maze back", "[engine][maze_file]") {
    const Maze maze = generate_maze({16, 16, 3});
    for (const MazeFormat format : {MazeFormat::contest, MazeFormat::map, MazeFormat::maz, MazeFormat::num})
        CHECK(maze_of(write_maze(maze, format).value()) == maze);
}

TEST_CASE("a file that is not a maze is refused in one line", "[engine][maze_file]") {
    CHECK(error_of("") == "m.txt: expected a drawing of a maze, got an empty file");
    CHECK(error_of("hello\n") ==
          "m.txt: expected a drawing of a maze, whose rows begin with a post as in \"o---o\" or with \"|\"");
    CHECK(error_of("title\no---o---o\n|    -- |\no---o---o\n") ==
          "m.txt:3: expected \"   \" from character 6 on, got \"-- \"");
    CHECK(error_of("o---o---o\n|       |\n") ==
          "m.txt: expected 2 rows for each cell and one more, for 1 to 64 cells, got 2 rows");
}
