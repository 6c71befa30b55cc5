// The shapes of a world and searches by place, for fixed shapes and movers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/grid.hpp"
#include "sim/shape.hpp"

namespace nezumi::sim {

/// Shapes by number, in the order of adding. Fixed shapes and movers are numbered separately, from 0. Several threads
/// may search at once while no other one adds, moves or refreshes.
class Scene {
public:
    using Index = std::uint32_t;
    static constexpr Index nobody = ~Index{0};

    Index add_fixed(const Shape& shape);
    /// `reach` [m] is the radius of the shape and of everything that moves with it.
    Index add_mover(const Shape& shape, double reach);
    Index add_mover(const Shape& shape) { return add_mover(shape, shape.reach()); }

    /// Removes a mover: searches no longer find it, and its number is not used again.
    void remove_mover(Index index);

    /// Moves a fixed shape.
    void move_fixed(Index index, const Shape& shape);

    const std::vector<Shape>& fixed() const { return fixed_; }
    const std::vector<Shape>& movers() const { return movers_; }

    /// For moving a mover. Searches use its position at the last refresh.
    Shape& mover(Index index) { return movers_[index]; }

    /// Searches use the present places of all movers from now on.
    void refresh();

    /// Calls `visit(index, shape)` for every fixed shape that may lie within `reach` of (x, y), seen from above. Some
    /// may be farther away, and one may be visited twice. The order is not defined.
    template <class Visit>
    void for_each_fixed_near(double x, double y, double reach, Visit&& visit) const {
        const auto look = [&](Index i) {
            if (bounds_[i].touches(x, y, reach)) visit(i, fixed_[i]);
        };
        if (fixed_.size() <= few) {
            for (Index i = 0; i < fixed_.size(); ++i) look(i);
            return;
        }
        fixed_grid_.for_each_near(x, y, reach, look);
        for (const Index i : large_fixed_) look(i);
    }

    /// Visits the movers near a point, each once.
    template <class Visit>
    void for_each_mover_near(double x, double y, double reach, Index except, Visit&& visit) const {
        const auto look = [&](Index i) {
            const Spot& spot = spots_[i];
            const double dx = spot.x - x, dy = spot.y - y, far = reach + spot.reach;
            if (i != except && dx * dx + dy * dy <= far * far) visit(i, movers_[i]);
        };
        if (movers_.size() <= few) {
            for (Index i = 0; i < movers_.size(); ++i) look(i);
            return;
        }
        mover_grid_.for_each_near(x, y, reach + largest_reach_, look);
        for (const Index i : large_movers_) look(i);
    }

private:
    static constexpr double cell_size = 0.5;      // [m]
    static constexpr std::size_t few = 8;         // up to this number a linear search is faster than the grid
    static constexpr double large_reach = 0.5;    // [m] a mover with this reach or more is kept out of the grid
    static constexpr double most_cells = 20'000;  // a fixed shape over more cells is kept out of the grid

    // The bounding rectangle of a shape seen from above.
    struct Bounds {
        double min_x, max_x, min_y, max_y;
        bool touches(double x, double y, double reach) const {
            return x + reach >= min_x && x - reach <= max_x && y + reach >= min_y && y - reach <= max_y;
        }
    };
    // The data for the search of movers: small, so that many fit into a cache line.
    struct Spot {
        double x, y, reach;
    };

    void keep(Index mover);

    std::vector<Shape> fixed_;
    std::vector<Bounds> bounds_;
    Grid fixed_grid_{cell_size};
    std::vector<Index> large_fixed_;

    std::vector<Shape> movers_;
    std::vector<Spot> spots_;
    Grid mover_grid_{cell_size};
    std::vector<Index> large_movers_;
    double largest_reach_ = 0;  // of the movers in the grid
};

}  // namespace nezumi::sim
