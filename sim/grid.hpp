// A uniform grid over the floor for searches by place. Cells are hashed, so the grid has no bounds.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nezumi::sim {

/// Stores numbers in square cells of the floor. The visited numbers and their order depend only on what was inserted.
/// Several threads may read at the same time.
class Grid {
public:
    /// `cell` is the edge of a cell [m].
    explicit Grid(double cell) : cell_(cell), inverse_(1 / cell) { heads_.assign(16, no_node); }

    double cell() const { return cell_; }
    bool empty() const { return nodes_.empty(); }

    void clear() {
        nodes_.clear();
        heads_.assign(heads_.size(), no_node);
    }

    /// Stores `id` in the cell that contains (x, y).
    void insert(std::uint32_t id, double x, double y) { insert_in_cell(id, index(x), index(y)); }

    /// Stores `id` in the cell with these indices, as `index` gives them.
    void insert_in_cell(std::uint32_t id, std::int32_t column, std::int32_t row) {
        if (nodes_.size() * 2 >= heads_.size()) grow();
        link({column, row, id, no_node});
    }

    /// The column of an x, or the row of a y. Beyond a million cells from the origin, all points are in the outermost
    /// cells.
    std::int32_t index(double at) const {
        const double cell = std::floor(at * inverse_);
        return static_cast<std::int32_t>(cell < -1e6 ? -1e6 : (cell > 1e6 ? 1e6 : cell));
    }

    /// Calls `visit(id)` for everything stored in a cell that the square of half edge `reach` about (x, y) touches. An
    /// id stored in several cells is visited once for each.
    template <class Visit>
    void for_each_near(double x, double y, double reach, Visit&& visit) const {
        const std::int32_t right = index(x + reach), top = index(y + reach), bottom = index(y - reach);
        for (std::int32_t column = index(x - reach); column <= right; ++column) {
            for (std::int32_t row = bottom; row <= top; ++row) {
                for (std::uint32_t n = heads_[bucket(column, row)]; n != no_node; n = nodes_[n].next) {
                    if (nodes_[n].column == column && nodes_[n].row == row) visit(nodes_[n].id);
                }
            }
        }
    }

private:
    static constexpr std::uint32_t no_node = ~std::uint32_t{0};

    struct Node {
        std::int32_t column;
        std::int32_t row;
        std::uint32_t id;
        std::uint32_t next;
    };

    std::size_t bucket(std::int32_t column, std::int32_t row) const {
        const std::uint32_t mixed =
            static_cast<std::uint32_t>(column) * 0x9E3779B1u ^ static_cast<std::uint32_t>(row) * 0x85EBCA77u;
        return (mixed ^ (mixed >> 15)) & (heads_.size() - 1);
    }

    void link(Node node) {
        std::uint32_t& head = heads_[bucket(node.column, node.row)];
        node.next = head;
        head = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(node);
    }

    void grow() {
        const std::vector<Node> old = std::move(nodes_);
        nodes_.clear();
        heads_.assign(heads_.size() * 2, no_node);
        for (const Node& node : old) link(node);
    }

    double cell_;
    double inverse_;
    std::vector<std::uint32_t> heads_;  // size is a power of two
    std::vector<Node> nodes_;
};

}  // namespace nezumi::sim
