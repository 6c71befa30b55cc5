// What moves in a world: robots and things, each a body of ODE.
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

/// A body of ODE, read through the pointers that it keeps for life.
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
    /// Velocity [m/s] of the point that is now at `from_centre` from the centre, in the world's directions.
    Vec3 velocity_at(const Vec3& from_centre) const { return velocity() + spin().cross(from_centre); }
    /// Whether it is somewhere and no faster than anything here can be.
    bool is_sound() const { return centre().allFinite() && spin().allFinite() && velocity().squaredNorm() < 1e6; }
    /// Puts it there, at rest.
    void put(const Vec3& centre, const Rotation& rotation) const;
    BodyState state() const;
    /// Puts it to where a state of it has got by `BodyState::advance`.
    void arrive(const BodyState& state) const;

    dBodyID id;
    const dReal *p, *r, *v, *w;
};

/// Puts the hull of a robot to where its body is.
inline void place_hull(Shape& hull, const RobotModel& model, const Vec3& centre, const Rotation& rotation) {
    hull.rotation = rotation;
    hull.centre = centre + hull.rotation.col(2) * model.hull_drop;
}
inline void place_hull(Shape& hull, const RobotModel& model, const BodyView& body) {
    place_hull(hull, model, body.centre(), body.rotation());
}

/// Who is near a mover: the only ones that are looked at in a step.
struct Neighbours {
    std::vector<Scene::Index> fixed;
    std::vector<Scene::Index> movers;
};

/// What a robot can touch: a fixed shape of the scene, or a mover.
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

    /// The rays of its range sensors with the servos as they are.
    const RayFan& fan() const { return turned_fan != nullptr ? *turned_fan : model->fan; }
    /// Whether ODE's solver moves it in the step that comes.
    void leave_to_ode(bool solved_by_ode);
    /// Whether nothing but how it moves keeps it from rolling freely.
    bool may_roll() const { return !kept_by_ode && !meets && !coasting && !constraint; }
    /// Whether its wheels are held where they are.
    bool is_held() const { return !coasting && speeds.left == 0 && speeds.right == 0; }
    /// Turns its driven wheels as in so many steps of `step` [s].
    void turn_wheels(double step, int steps = 1);

    BodyView body;
    RobotModel* model;  // its contacts are filled in on the way to ODE
    Scene::Index mover;
    bool gone = false;  // removed: nobody meets or sees it any more, and its number is not given again
    bool left = false;  // the arena, once
    bool has_neighbours = false;
    bool meets = false;        // touches something else than the flat floor, in this step
    bool by_ode = true;        // ODE's solver moves it; otherwise it rolls freely
    bool kept_by_ode = false;  // always: for tests that compare the two
    bool coasting = false;
    bool on_slope = false;  // a wheel or skid stands on a slope, in this step
    Wheels speeds;          // [m/s]
    Wheels angles;          // [rad]
    ConstraintMotors constraint;
    std::unique_ptr<RayFan> turned_fan;  // once a servo that carries a sensor has moved
    Motion rolling{};                    // of one that rolls freely, after the step
    std::optional<Obstacle> touched;     // first in this call of `step`
    std::vector<Vec3> contact_points;    // of the latest step of this call in which it touched something
    Neighbours near;
    std::string name;
    std::vector<bool> pressed;   // by sensor of the spec
    std::vector<double> servos;  // [rad] by actuator of the spec
};

/// A movable box or cylinder.
struct Thing {
    Thing(dBodyID id, Scene::Index its_mover, double its_mass) : body(id), mover(its_mover), mass(its_mass) {}

    /// Somebody touches it: it moves again, if it slept.
    void wake();
    /// Lies still from now on, at no cost, until it is touched.
    void sleep();

    BodyView body;
    Scene::Index mover;
    double mass;
    bool asleep = false;
    int quiet_steps = 0;
    Neighbours near;
};

/// All that move. As movers of the scene, the things come first, then the robots.
struct Movers {
    std::vector<Thing> things;
    std::vector<SimRobot> robots;

    bool is_thing(Scene::Index mover) const { return mover < things.size(); }
    SimRobot& robot(Scene::Index mover) { return robots[mover - things.size()]; }
};

}  // namespace nezumi::sim
