// Movers that touch each other form an island; which islands are too large for the exact solver.
#pragma once

#include <utility>
#include <vector>

#include "sim/scene.hpp"

namespace nezumi::sim {

/// `dWorldStep` is exact, and its cost grows with the cube of the equations in the island: with 20 (a mouse at a wall)
/// 5 us a robot, 40 (two of them) 11, 60 (three) 28, 80 (four) 74. `dWorldQuickStep` iterates and stays at 5.
class Islands {
public:
    /// Up to so many equations exactness is worth its time.
    static constexpr int most_equations = 45;
    /// A mover that touches nothing that moves (a plate on a row of pillars) is solved with up to so many: 300 take 1
    /// ms.
    static constexpr int most_alone = 300;
    /// Of a robot that stands on the floor; a thing on its corners has 12.
    static constexpr int equations_on_floor = 8;

    /// The movers' numbers are given in the order of adding, as in a `Scene`.
    void add_mover();

    /// Begins a step: nobody touches anybody.
    void clear();
    /// Counts equations of contacts with something else than the floor for `mover`.
    void add_equations(Scene::Index mover, int count) {
        equations_[mover] += count;
        crowded_ = crowded_ || equations_[mover] > most_alone;
    }
    /// The two touch each other.
    void link(Scene::Index a, Scene::Index b) { links_.emplace_back(a, b); }

    /// Fills in `is_large`. False when no island is large.
    bool find_large();
    /// Whether `mover` is part of a large island, as found last.
    bool is_large(Scene::Index mover) const { return large_[mover]; }

private:
    Scene::Index root(Scene::Index mover);

    std::vector<std::pair<Scene::Index, Scene::Index>> links_;
    bool crowded_ = false;  // a mover has more than `most_alone`
    // By mover:
    std::vector<int> equations_;
    std::vector<Scene::Index> parents_;  // of the search; each its own when idle
    std::vector<bool> large_;
};

}  // namespace nezumi::sim
