// Robots without neighbours take all steps of a tick at once, so that the memory of each is read once a tick.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/scene.hpp"

namespace nezumi {
class WorkerPool;
}

namespace nezumi::sim {

/// While neighbour lists are valid, a robot without neighbours touches no other mover. So the result is the same if it
/// is ahead of the others. Its previous state is kept, because the lists may expire early.
class RollingAhead {
public:
    /// `step` [s] is the length of a step. `movers` and `scene` must outlive this object.
    RollingAhead(Movers& movers, Scene& scene, double step) : movers_(movers), scene_(scene), step_(step) {}

    /// Threads that share the robots; null for none. The result does not depend on their number.
    void use(WorkerPool* workers) { workers_ = workers; }

    /// Advances all robots that have no neighbours and roll freely by `steps` steps, with their hulls. Neighbour lists
    /// must be up to date.
    void go(int steps);
    /// The robots that must take their steps one by one, in the order of adding: all those that are not ahead.
    std::span<SimRobot* const> others() const { return others_; }
    /// The squared speed [m^2/s^2] of the fastest robot that is ahead, after step `i`, counted from 0.
    double fastest_squared(int i) const { return fastest_.empty() ? 0 : fastest_[static_cast<std::size_t>(i)]; }
    /// Moves the robots that are ahead back to their state after `steps` steps, if the others have taken only these.
    void go_back_to(int steps);

private:
    struct Before {
        BodyState body;
        Wheels angles;  // [rad]
    };

    template <class Action>
    void share_out(int steps, const Action& action);
    void roll(std::span<const std::size_t> robots, int steps, std::vector<double>& fastest);
    template <class Wanted>
    void roll_all(std::size_t begin, std::size_t end, int steps, std::vector<double>& fastest, const Wanted& wanted);

    Movers& movers_;
    Scene& scene_;
    double step_;
    WorkerPool* workers_ = nullptr;
    int taken_ = 0;                                // steps
    std::vector<Before> before_;                   // index: robot; the state before, if it is ahead
    std::vector<std::uint8_t> is_ahead_;           // index: robot
    std::vector<SimRobot*> others_;                // valid within a call of `OdeWorld::step`
    std::vector<double> fastest_;                  // index: step
    std::vector<std::vector<double>> fastest_of_;  // indices: thread, step
};

}  // namespace nezumi::sim
