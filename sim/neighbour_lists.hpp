// Lists of neighbours, renewed only when another mover could have come near since.
#pragma once

#include "sim/bodies.hpp"
#include "sim/scene.hpp"

namespace nezumi::sim {

class NeighbourLists {
public:
    /// Neighbours are listed up to this distance [m].
    static constexpr double skin = 0.06;

    /// True if two movers that are not listed as neighbours may touch by now.
    bool expired() const { return may_travel_ < 0; }
    void expire() { may_travel_ = -1; }
    /// Called after a step in which every mover has moved at most this distance [m].
    void travel(double distance) {
        may_travel_ -= distance;
        travelled_ = distance;
    }
    /// An estimate of the number of steps for which the lists stay valid at the present speeds: 1 to `most`.
    int steps_left(int most) const {
        return may_travel_ < travelled_ * most ? static_cast<int>(may_travel_ / travelled_) + 1 : most;
    }

    /// Lists the neighbours of all movers. The scene must be refreshed.
    void list(const Scene& scene, Movers& movers);

private:
    double may_travel_ = -1;  // [m] left until the lists expire
    double travelled_ = 0;    // [m] in the previous step
};

}  // namespace nezumi::sim
