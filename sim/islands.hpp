// Islands of movers that touch each other, and which of them are too large for the exact solver.
#pragma once

#include <utility>
#include <vector>

#include "sim/scene.hpp"

namespace nezumi::sim {

/// `dWorldStep` is exact, but its cost grows with the cube of an island's equations. Measured: 20 equations (a mouse at
/// a wall) 5 us per robot, 40 (two mice) 11, 60 (three) 28, 80 (four) 74. `dWorldQuickStep` iterates and stays at 5.
class Islands {
public:
    /// Up to this number the exact solver is worth its time.
    static constexpr int most_equations = 45;
    /// Limit for a mover that touches no other mover (a plate on pillars): 300 equations take 1 ms.
    static constexpr int most_alone = 300;
    /// The equations of a robot's contacts with the floor. A thing on its corners has 12.
    static constexpr int equations_on_floor = 8;

    /// Movers are numbered in the order of adding, as in a `Scene`.
    void add_mover();

    /// Begins a step without links.
    void clear();
    /// Adds `count` equations of contacts with anything other than the floor.
    void add_equations(Scene::Index mover, int count) {
        equations_[mover] += count;
        crowded_ = crowded_ || equations_[mover] > most_alone;
    }
    /// Records that the two touch.
    void link(Scene::Index a, Scene::Index b) { links_.emplace_back(a, b); }

    /// Computes `is_large`. Returns false if no island is large.
    bool find_large();
    /// True if `mover` is part of a large island, as last computed.
    bool is_large(Scene::Index mover) const { return large_[mover]; }

private:
    Scene::Index root(Scene::Index mover);

    std::vector<std::pair<Scene::Index, Scene::Index>> links_;
    bool crowded_ = false;  // a mover has more than `most_alone`
    // By mover:
    std::vector<int> equations_;
    std::vector<Scene::Index> parents_;  // of union-find; each mover is its own parent outside a search
    std::vector<bool> large_;
};

}  // namespace nezumi::sim
