// Robots that nobody is near take the steps of a whole tick in one go, so that each one's memory is walked once a tick.
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

/// While neighbours' lists hold, a robot without neighbours meets nobody and nobody meets it: whether it is ahead of
/// the others makes no difference to the result. Where it was before is kept, as the lists may turn out not to have
/// held for as long.
class RollingAhead {
public:
    /// `step` [s] is the length of a step. All must outlive it.
    RollingAhead(Movers& movers, Scene& scene, double step) : movers_(movers), scene_(scene), step_(step) {}

    /// Threads that share out the robots; the result is the same with any number. Null: none.
    void use(WorkerPool* workers) { workers_ = workers; }

    /// Puts all robots that have no neighbours and roll freely for so many steps to where these lead, and their hulls
    /// with them. Lists of neighbours must be up to date.
    void go(int steps);
    /// The robots that have to take their steps one by one, in the order of adding: all others that are there.
    std::span<SimRobot* const> others() const { return others_; }
    /// The speed [m/s], squared, of the fastest of those that are ahead, after step `i` from 0.
    double fastest_squared(int i) const { return fastest_.empty() ? 0 : fastest_[static_cast<std::size_t>(i)]; }
    /// Puts those that are ahead to where they were after the first `steps`, when the others have not taken more.
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
    std::vector<Before> before_;                   // by robot, where it was, of those that are ahead
    std::vector<std::uint8_t> is_ahead_;           // by robot
    std::vector<SimRobot*> others_;                // good within a call of `OdeWorld::step`
    std::vector<double> fastest_;                  // by step
    std::vector<std::vector<double>> fastest_of_;  // by thread and step
};

}  // namespace nezumi::sim
