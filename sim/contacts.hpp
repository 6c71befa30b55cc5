// The contacts of a step: robots and things with the floor and with each other, as joints of ODE.
#pragma once

#include <span>
#include <utility>
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
    /// `step` [s] is the length of a step. All other arguments must outlive this object.
    Contacts(dWorldID world, double step, const Scene& scene, Movers& movers, Islands& islands);

    /// Makes the contacts of these robots, and of the things that are awake, with the floor and their neighbours.
    /// Records which bodies touched and wakes touched things. A robot that touches no mover gets its `SimRobot::next`
    /// instead of joints. `robots` must contain all robots that have neighbours, in the order of adding. The neighbour
    /// lists and the scene must be up to date.
    void find(std::span<SimRobot* const> robots);
    /// Clears the records of touches.
    void forget_touches();
    /// True if ODE has something to solve in this step.
    bool any_by_ode() const { return any_by_ode_; }
    /// True if the last `find` had more contacts than a step has room for; the rest was left out, except for contacts
    /// with the floor. Piled things have about 24 contacts each; more means that they overlap.
    bool is_full() const { return count_ >= most_contacts(); }
    std::size_t most_contacts() const { return 1000 + 32 * (movers_.robots.size() + movers_.things.size()); }
    /// Removes the contacts after the step.
    void clear();
    /// Gives up the joints without destroying them: for a world that broke down.
    void keep() { OdeLibrary::keep(joints_.release()); }

private:
    void advance(SimRobot& robot);
    void touch_floor(SimRobot& robot);
    void touch_neighbours(SimRobot& robot);
    // Records that the robot touches this obstacle at the latest contacts.
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
    void join();

    dWorldID world_;
    double step_;
    const Scene& scene_;
    Movers& movers_;
    Islands& islands_;
    JointGroupHandle joints_;
    std::vector<dContact> found_;                     // of the mover that is being checked, not yet joints
    std::vector<std::pair<dBodyID, dBodyID>> pairs_;  // the two bodies of each contact in found_
    std::size_t count_ = 0;
    std::vector<Scene::Index> touched_;  // movers: robots that have touched something
    std::vector<Vec3> points_;           // contact points of the pair that is being checked
    bool any_by_ode_ = false;
    NarrowPhase narrow_;
};

}  // namespace nezumi::sim
