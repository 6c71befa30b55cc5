// `nezumi maze`: draws a maze, says the shortest way through it, and writes it in another format.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/console/put_text.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/world/maze_file.hpp"
#include "engine/world/maze_way.hpp"

namespace nezumi::cli {
namespace {

struct MazeOptions {
    std::string file, output, format;
    bool way = false;
};

Expected<MazeFormat> format_named(std::string_view name) {
    const auto found = std::find(maze_formats.begin(), maze_formats.end(), name);
    if (found != maze_formats.end()) return static_cast<MazeFormat>(found - maze_formats.begin());
    return failure(fmt::format("maze: there is no format '{}'{}; known are {}", shown(name),
                               did_you_mean(name, maze_formats), fmt::join(maze_formats, ", ")));
}

// The way as text: "N3 E2 S1" is 3 cells north, 2 east, 1 south. Sets the number of turns.
std::string steps_of(const std::vector<MazeCell>& way, int& turns) {
    struct Leg {
        char side;
        int cells;
    };
    std::vector<Leg> legs;
    for (std::size_t i = 1; i < way.size(); ++i) {
        const int right = way[i].column - way[i - 1].column, up = way[i].row - way[i - 1].row;
        const char side = right > 0 ? 'E' : right < 0 ? 'W' : up > 0 ? 'N' : 'S';
        if (legs.empty() || legs.back().side != side) legs.push_back({side, 0});
        ++legs.back().cells;
    }
    turns = std::max(0, static_cast<int>(legs.size()) - 1);
    std::string text;
    for (const Leg& leg : legs) text += fmt::format("{}{}{}", text.empty() ? "" : " ", leg.side, leg.cells);
    return text;
}

// The drawing, with a point in each cell of the way that has no mark.
std::string drawn_with(const Maze& maze, const std::vector<MazeCell>& way) {
    std::vector<std::string> rows = draw_maze(maze);
    for (const MazeCell& cell : way) {
        char& sign = rows[static_cast<std::size_t>(2 * (maze.rows() - cell.row) - 1)]
                         [static_cast<std::size_t>(4 * cell.column + 2)];
        if (sign == ' ') sign = '.';
    }
    return fmt::format("{}\n", fmt::join(rows, "\n"));
}

std::string told(const Maze& maze, const std::vector<MazeCell>& way) {
    std::string text = fmt::format("{} x {} cells", maze.columns(), maze.rows());
    if (const int reachable = reachable_cells(maze); reachable < maze.columns() * maze.rows())
        text += fmt::format(", {} of them reachable", reachable);
    const MazeCell start = maze.start();
    text += fmt::format("\nstart: {} {}{}\ngoal:", start.column + 1, start.row + 1,
                        maze.marked_start ? "" : " (not marked: the south-west cell)");
    for (const MazeCell& goal : maze.goals()) text += fmt::format(" {} {},", goal.column + 1, goal.row + 1);
    text.back() = '\n';
    if (maze.marked_goals.empty()) text.insert(text.size() - 1, " (not marked: the middle)");
    if (way.empty()) return text + "no way leads from the start to the goal\n";
    if (way.size() == 1) return text + "shortest way: the start is a goal\n";
    int turns = 0;
    const std::string steps = steps_of(way, turns);
    const auto count = [](std::size_t number, std::string_view what) {
        return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
    };
    return text + fmt::format("shortest way: {}, {}: {}\n", count(way.size() - 1, "step"),
                              count(static_cast<std::size_t>(turns), "turn"), steps);
}

Expected<void> maze_to(const MazeOptions& options) {
    const auto content = read_whole(options.file, options.file);
    if (!content) return Unexpected(content.error());
    const auto maze = read_maze(*content, options.file);
    if (!maze) return Unexpected(maze.error());
    if (options.output.empty() && options.format.empty()) {
        const auto way = shortest_way(*maze);
        put_text(stdout, drawn_with(*maze, way) + told(*maze, way));
        return {};
    }
    std::string name = options.format;
    if (name.empty()) {
        name = std::filesystem::path(options.output).extension().string();
        if (!name.empty()) name.erase(0, 1);
    }
    const auto format = format_named(name);
    if (!format) return Unexpected(format.error());
    const auto text = write_maze(*maze, *format);
    if (!text) return Unexpected(text.error());
    if (!options.output.empty()) return write_whole(options.output, *text);
    put_text(stdout, *text);
    return {};
}

}  // namespace

SubCommand maze_command() {
    auto options = std::make_shared<MazeOptions>();
    return {
        .name = "maze",
        .help = "Draw a maze of a contest, tell its shortest way, or write it in another format",
        .options = {{"FILE", &options->file, "a drawing, a .maz or a .num file", "", {}, FileUse::source},
                    {"-o,--output",
                     &options->output,
                     "write it to this file; its ending tells the format",
                     "OUT.txt|.map|.maz|.num",
                     {},
                     FileUse::result},
                    {"--as", &options->format, "write this format (default: as the ending of -o)", "txt|map|maz|num"}},
        .run =
            [options] {
                const auto done = maze_to(*options);
                return done ? exit_done : refuse(done.error());
            },
        .footer =
            "txt is the drawing of contests with posts o, map the same with posts +, maz a byte for each of 16 x 16 "
            "cells,\nnum a line \"X Y N E S W\" for each cell. Points in the drawing are the shortest way."};
}

}  // namespace nezumi::cli
