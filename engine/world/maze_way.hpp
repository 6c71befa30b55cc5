// Ways through a maze from cell to cell.
#pragma once

#include <vector>

#include "engine/world/maze.hpp"

namespace nezumi {

/// The shortest way from the start to the nearest goal, both included; of several, one with the fewest turns. Empty if
/// there is none.
std::vector<MazeCell> shortest_way(const Maze& maze);

/// How many of the cells can be reached from the start.
int reachable_cells(const Maze& maze);

}  // namespace nezumi
