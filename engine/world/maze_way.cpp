// Searches states of cell and direction. A step costs more than all turns, so turns count only between equal lengths.
#include "engine/world/maze_way.hpp"

#include <algorithm>
#include <cstddef>
#include <queue>

namespace nezumi {
namespace {

constexpr int step_cost = 10'000;  // more than all turns of any way
constexpr int turn_cost = 1;

class Search {
public:
    explicit Search(const Maze& maze)
        : maze_(maze), costs_(static_cast<std::size_t>(maze.columns() * maze.rows() * 4), -1), from_(costs_.size()) {
        visit(maze.start(), maze.start_side(), 0, 0);
        while (!open_.empty()) {
            const auto [cost, index] = open_.top();
            open_.pop();
            if (cost != costs_[index]) continue;
            const MazeCell cell = cell_of(index);
            for (const MazeSide side : maze_sides) {
                if (maze_.is_wall(cell, side) || !maze_.has(beside(cell, side))) continue;
                const int turn = side == static_cast<MazeSide>(index % 4) ? 0 : turn_cost;
                visit(beside(cell, side), side, cost + step_cost + turn, index);
            }
        }
    }

    // The cost of the cheapest state in a cell, or -1 if the cell can't be reached.
    int cost(MazeCell cell) const {
        int best = -1;
        for (const MazeSide side : maze_sides) {
            const int cost = costs_[index_of(cell, side)];
            if (cost >= 0 && (best < 0 || cost < best)) best = cost;
        }
        return best;
    }

    std::vector<MazeCell> way_to(MazeCell goal) const {
        std::size_t index = 0;
        for (const MazeSide side : maze_sides) {
            if (costs_[index_of(goal, side)] == cost(goal)) index = index_of(goal, side);
        }
        std::vector<MazeCell> way{cell_of(index)};
        while (costs_[index] != 0) {
            index = from_[index];
            way.push_back(cell_of(index));
        }
        std::reverse(way.begin(), way.end());
        return way;
    }

private:
    std::size_t index_of(MazeCell cell, MazeSide side) const {
        return static_cast<std::size_t>((cell.row * maze_.columns() + cell.column) * 4) +
               static_cast<std::size_t>(side);
    }
    MazeCell cell_of(std::size_t index) const {
        const int number = static_cast<int>(index / 4);
        return {number % maze_.columns(), number / maze_.columns()};
    }
    void visit(MazeCell cell, MazeSide side, int cost, std::size_t from) {
        const std::size_t index = index_of(cell, side);
        if (costs_[index] >= 0 && costs_[index] <= cost) return;
        costs_[index] = cost;
        from_[index] = from;
        open_.emplace(cost, index);
    }

    const Maze& maze_;
    std::vector<int> costs_;
    std::vector<std::size_t> from_;
    std::priority_queue<std::pair<int, std::size_t>, std::vector<std::pair<int, std::size_t>>, std::greater<>> open_;
};

}  // namespace

std::vector<MazeCell> shortest_way(const Maze& maze) {
    const Search search(maze);
    std::vector<MazeCell> best;
    int least = -1;
    for (const MazeCell goal : maze.goals()) {
        const int cost = search.cost(goal);
        if (cost < 0 || (least >= 0 && cost >= least)) continue;
        least = cost;
        best = search.way_to(goal);
    }
    return best;
}

int reachable_cells(const Maze& maze) {
    const Search search(maze);
    int count = 0;
    for (int column = 0; column < maze.columns(); ++column) {
        for (int row = 0; row < maze.rows(); ++row) count += search.cost({column, row}) >= 0 ? 1 : 0;
    }
    return count;
}

}  // namespace nezumi
