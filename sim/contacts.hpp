// The contacts of a step: robots and things with the floor and with each other, as joints of ODE.
#pragma once

#include <span>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/islands.hpp"
#include "sim/narrow_phase.hpp"
#include "sim/ode_library.hpp"
#include "sim/robot_model.hpp"
#include "sim/scene.hpp"

namespace nezumi::sim {

class Contacts {
public:
    /// `step` [s] is the length of a step. All must outlive it, the world first.
    Contacts(dWorldID world, double step, const Scene& scene, Movers& movers, Islands& islands);

    /// Makes the contacts of these robots and of the things that are awake with the floor and their neighbours, notes
    /// who has touched whom, and wakes what is touched. Whoever rolls freely gets no contacts but its
    /// `SimRobot::rolling`. All robots that have neighbours must be among them. Neighbours and places in the scene must
    /// be up to date.
    void find(std::span<SimRobot* const> robots);
    /// Forgets who has touched whom.
    void forget_touches();
    /// Whether there is anything for ODE in this step.
    bool any_by_ode() const { return any_by_ode_; }
    /// Whether there were more than a step has room for in the last `find`: what touches what was left out from there
    /// on, the floor apart. Things that are heaped up have about 24 each; more means that they lie in each other.
    bool is_full() const { return count_ >= most_contacts(); }
    std::size_t most_contacts() const { return 1000 + 32 * (movers_.robots.size() + movers_.things.size()); }
    /// Removes them after the step.
    void clear();
    /// Gives up the joints without destroying them, after a breakdown.
    void keep() { OdeLibrary::keep(joints_.release()); }

private:
    bool rolls_freely(SimRobot& robot) const;
    void touch_floor(SimRobot& robot);
    void touch_neighbours(SimRobot& robot);
    // Notes that it touches this, where the latest contacts are.
    void meet(SimRobot& robot, const Obstacle& obstacle);
    void touch_fixed(SimRobot& robot, Scene::Index fixed);
    void touch_thing(SimRobot& robot, Scene::Index thing);
    void touch_robot(SimRobot& robot, SimRobot& other);
    bool roll_over(SimRobot& robot, const Shape& shape, dBodyID other);
    int touch_beside(SimRobot& robot, const Shape& shape, dBodyID other, const Spring& spring);
    void touch_floor(Thing& thing);
    void touch_neighbours(Thing& thing);
    void touch_floor_with(const Shape& shape, dBodyID body, const Spring& spring, double friction);
    Spring spring_of(const Thing& thing) const;

    void add_wheel_contact(SimRobot& robot, int side, const Touch& touch, const Vec3& forward, dBodyID other);
    void add_skid_contact(SimRobot& robot, const Touch& touch, dBodyID other);
    void add_contact(dBodyID a, dBodyID b, const Touch& touch, const Spring& spring, double friction);
    void attach(const dContact& contact, dBodyID a, dBodyID b);

    dWorldID world_;
    double step_;
    const Scene& scene_;
    Movers& movers_;
    Islands& islands_;
    JointGroupHandle joints_;
    std::size_t count_ = 0;
    std::vector<Scene::Index> touched_;  // movers: robots that have touched something
    std::vector<Vec3> points_;           // of the contacts of the pair that is looked at
    bool any_by_ode_ = false;
    NarrowPhase narrow_;
};

}  // namespace nezumi::sim
