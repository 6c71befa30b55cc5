// Who is near whom, listed anew only when somebody could have come near since.
#pragma once

#include "sim/bodies.hpp"
#include "sim/scene.hpp"

namespace nezumi::sim {

class NeighbourLists {
public:
    /// [m] Neighbours are listed up to this distance.
    static constexpr double skin = 0.06;

    /// Whether two that are not neighbours may touch by now.
    bool expired() const { return may_travel_ < 0; }
    void expire() { may_travel_ = -1; }
    /// Nobody has moved farther than this [m] since the last call.
    void travel(double distance) {
        may_travel_ -= distance;
        travelled_ = distance;
    }
    /// For how many steps the lists will hold if all go on as fast: at least 1, at most `most`. A guess.
    int steps_left(int most) const {
        return may_travel_ < travelled_ * most ? static_cast<int>(may_travel_ / travelled_) + 1 : most;
    }

    /// Fills in the neighbours of all movers; the scene must be refreshed.
    void list(const Scene& scene, Movers& movers);

private:
    double may_travel_ = -1;  // [m]
    double travelled_ = 0;    // [m] in the step before
};

}  // namespace nezumi::sim
