// The bodies that move in a world: robots and things.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/body_state.hpp"
#include "sim/constraint_motors.hpp"
#include "sim/ode_library.hpp"
#include "sim/robot_model.hpp"
#include "sim/scene.hpp"

namespace nezumi::sim {

/// A view of an ODE body. Its pointers stay valid as long as the body lives.
struct BodyView {
    explicit BodyView(dBodyID body)
        : id(body),
          p(dBodyGetPosition(body)),
          r(dBodyGetRotation(body)),
          v(dBodyGetLinearVel(body)),
          w(dBodyGetAngularVel(body)) {}

    Vec3 centre() const { return Eigen::Map<const Vec3>(p); }
    Rotation rotation() const { return Eigen::Map<const RowMajor3x4>(r).leftCols<3>(); }
    Vec3 velocity() const { return Eigen::Map<const Vec3>(v); }
    Vec3 spin() const { return Eigen::Map<const Vec3>(w); }
    /// Velocity [m/s], in the world frame, of the body's point that is now at `from_centre` from the centre.
    Vec3 velocity_at(const Vec3& from_centre) const { return velocity() + spin().cross(from_centre); }
    /// True if position and velocities are finite and the speed is plausible (below 1000 m/s).
    bool is_sound() const { return centre().allFinite() && spin().allFinite() && velocity().squaredNorm() < 1e6; }
    /// Places the body at rest.
    void put(const Vec3& centre, const Rotation& rotation) const;
    BodyState state() const;
    /// Sets pose and velocities of the body, bit for bit, after `BodyState::advance` has moved `state`.
    void arrive(const BodyState& state) const;

    dBodyID id;
    const dReal *p, *r, *v, *w;
};

/// Moves the hull of a robot to the pose of its body.
inline void place_hull(Shape& hull, const RobotModel& model, const Vec3& centre, const Rotation& rotation) {
    hull.rotation = rotation;
    hull.centre = centre + hull.rotation.col(2) * model.hull_drop;
}
inline void place_hull(Shape& hull, const RobotModel& model, const BodyView& body) {
    place_hull(hull, model, body.centre(), body.rotation());
}

/// The shapes near a mover. A step checks only these for contact.
struct Neighbours {
    std::vector<Scene::Index> fixed;
    std::vector<Scene::Index> movers;
};

/// An obstacle that a robot can touch: a fixed shape of the scene, or a mover.
struct Obstacle {
    bool moves = false;
    Scene::Index index = 0;
};

struct SimRobot {
    SimRobot(dBodyID id, RobotModel& its_model, Scene::Index its_mover, std::string its_name)
        : body(id),
          model(&its_model),
          mover(its_mover),
          name(std::move(its_name)),
          pressed(model->spec->sensors.size(), false),
          servos(model->spec->actuators.size(), 0.0) {}

    /// The rays of the robot's range sensors at the present servo angles.
    const RayFan& fan() const { return turned_fan != nullptr ? *turned_fan : model->fan; }
    /// Sets whether ODE's solver moves the robot in the next step.
    void leave_to_ode(bool solved_by_ode);
    /// True if the robot can roll freely, provided that its motion allows it.
    bool may_roll() const { return !meets && !coasting && is_alone(); }
    /// True if ODE is not needed: the robot touches nothing that moves, and no velocity is forced on it.
    bool is_alone() const { return !kept_by_ode && !meets_mover && !constraint; }
    /// True if the motors hold the wheels at standstill.
    bool is_held() const { return !coasting && speeds.left == 0 && speeds.right == 0; }
    /// Turns the driven wheels by `steps` steps of `step` [s].
    void turn_wheels(double step, int steps = 1);

    BodyView body;
    RobotModel* model;  // not const: its contacts are filled in before ODE gets them
    Scene::Index mover;
    bool gone = false;  // removed: it is invisible and touches nothing; its number is not used again
    bool left = false;  // has left the arena; reported once
    bool has_neighbours = false;
    bool meets = false;        // touches something other than the flat floor in this step
    bool meets_mover = false;  // touches a robot or a thing in this step
    bool by_ode = true;        // ODE's solver moves it
    bool kept_by_ode = false;  // ODE's solver always moves it: for tests that compare the solvers
    bool coasting = false;
    bool on_slope = false;  // a wheel or skid stands on a slope, in this step
    Wheels speeds;          // [m/s]
    Wheels angles;          // [rad]
    ConstraintMotors constraint;
    std::unique_ptr<RayFan> turned_fan;  // set when a servo that carries a sensor has moved
    Motion next{};                       // motion after the step, if ODE's solver does not move it
    std::optional<Obstacle> touched;     // the first obstacle touched in this call of `step`
    std::vector<Vec3> contact_points;    // points of the latest step of this call in which it touched something
    Neighbours near;
    std::string name;
    std::vector<bool> pressed;   // by sensor of the spec
    std::vector<double> servos;  // [rad] by actuator of the spec
};

/// A movable box or cylinder.
struct Thing {
    Thing(dBodyID id, Scene::Index its_mover, double its_mass) : body(id), mover(its_mover), mass(its_mass) {}

    /// Wakes the thing after a touch, so that it moves again.
    void wake();
    /// Puts the thing to sleep: it lies still and costs no time until it is touched.
    void sleep();

    BodyView body;
    Scene::Index mover;
    double mass;
    bool asleep = false;
    int quiet_steps = 0;
    Neighbours near;
};

/// All movers. In the scene, the things come first, then the robots.
struct Movers {
    std::vector<Thing> things;
    std::vector<SimRobot> robots;

    bool is_thing(Scene::Index mover) const { return mover < things.size(); }
    SimRobot& robot(Scene::Index mover) { return robots[mover - things.size()]; }
    const SimRobot& robot(Scene::Index mover) const { return robots[mover - things.size()]; }
};

}  // namespace nezumi::sim
