// Finds the contacts of a step: which shapes touch, where, and with which spring.
#include "sim/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "sim/contact_solver.hpp"
#include "sim/free_rolling.hpp"

namespace nezumi::sim {
namespace {

void set_touch(dContact& contact, const Touch& touch) {
    Eigen::Map<Vec3>(contact.geom.pos) = touch.at;
    Eigen::Map<Vec3>(contact.geom.normal) = touch.normal;
    contact.geom.depth = touch.depth;
}

// Steeper than 0.1 degrees: there gravity would make a standing robot creep by more than 0.4 mm a minute.
bool is_slope(const Vec3& normal) { return normal.z() < 0.999998; }

}  // namespace

Contacts::Contacts(dWorldID world, double step, const Scene& scene, Movers& movers, Islands& islands)
    : world_(world), step_(step), scene_(scene), movers_(movers), islands_(islands), joints_(dJointGroupCreate(0)) {}

void Contacts::find(std::span<SimRobot* const> robots) {
    count_ = 0;
    points_.clear();
    any_by_ode_ = false;
    for (SimRobot* robot : robots) {
        if (robot->has_neighbours) touch_neighbours(*robot);
        advance(*robot);
        robot->meets = robot->meets_mover = robot->on_slope = false;
    }
    for (Thing& thing : movers_.things) {
        if (thing.asleep) continue;
        touch_floor(thing);
        touch_neighbours(thing);
        any_by_ode_ = true;
        join();
    }
}

// Computes the robot's motion, or leaves it to ODE. All contacts except those with the floor must have been found.
void Contacts::advance(SimRobot& robot) {
    const auto state = [&] { return robot.body.state(); };
    std::optional<Motion> next;
    if (robot.may_roll()) next = roll_freely(*robot.model, state(), robot.speeds, step_);
    if (!next) {
        touch_floor(robot);
        if (robot.is_alone()) next = solve_contacts(*robot.model, state(), found_, step_);
    }
    robot.leave_to_ode(!next);
    if (next) {
        robot.next = *next;
        found_.clear();
        pairs_.clear();
    } else {
        any_by_ode_ = true;
        join();
    }
}

void Contacts::forget_touches() {
    for (const Scene::Index mover : touched_) {
        SimRobot& robot = movers_.robot(mover);
        robot.touched.reset();
        robot.contact_points.clear();
    }
    touched_.clear();
}

void Contacts::meet(SimRobot& robot, const Obstacle& obstacle) {
    if (!robot.meets) robot.contact_points.clear();
    robot.contact_points.insert(robot.contact_points.end(), points_.begin(), points_.end());
    robot.meets = true;
    robot.meets_mover = robot.meets_mover || obstacle.moves;
    if (robot.touched) return;
    robot.touched = obstacle;
    touched_.push_back(robot.mover);
}

void Contacts::clear() { dJointGroupEmpty(joints_.get()); }

Spring Contacts::spring_of(const Thing& thing) const {
    return Spring::from(per_kilogram::firm * thing.mass, per_kilogram::firm_damping * thing.mass, step_);
}

void Contacts::attach(const dContact& contact, dBodyID a, dBodyID b) {
    ++count_;
    points_.emplace_back(Eigen::Map<const Vec3>(contact.geom.pos));
    found_.push_back(contact);
    pairs_.emplace_back(a, b);
}

// Gives the contacts to ODE.
void Contacts::join() {
    for (std::size_t i = 0; i < found_.size(); ++i)
        dJointAttach(dJointCreateContact(world_, joints_.get(), &found_[i]), pairs_[i].first, pairs_[i].second);
    found_.clear();
    pairs_.clear();
}

void Contacts::add_contact(dBodyID a, dBodyID b, const Touch& touch, const Spring& spring, double friction) {
    dContact contact{};
    contact.surface.mode = sprung;
    contact.surface.mu = friction;
    contact.surface.soft_erp = spring.erp;
    contact.surface.soft_cfm = spring.cfm;
    set_touch(contact, touch);
    attach(contact, a, b);
}

// The motor turns the wheel. The rim moves backwards below the axle, so the robot moves along the first friction
// direction.
void Contacts::add_wheel_contact(SimRobot& robot, int side, const Touch& touch, const Vec3& forward, dBodyID other) {
    RobotModel& model = *robot.model;
    const bool is_held = robot.on_slope && robot.is_held();
    dContact& contact = robot.coasting ? model.coasting_contact : is_held ? model.held_contact : model.wheel_contact;
    contact.surface.motion1 = side == 0 ? robot.speeds.left : robot.speeds.right;
    set_touch(contact, touch);
    Eigen::Map<Vec3>(contact.fdir1) = forward;
    attach(contact, robot.body.id, other);
}

void Contacts::add_skid_contact(SimRobot& robot, const Touch& touch, dBodyID other) {
    set_touch(robot.model->skid_contact, touch);
    attach(robot.model->skid_contact, robot.body.id, other);
}

void Contacts::touch_floor(SimRobot& robot) {
    const RobotModel& model = *robot.model;
    const Supports supports = supports_of(model, robot.body.centre(), robot.body.rotation());
    for (std::size_t i = supports.wheels_stand ? 0 : Supports::wheels; i < Supports::count; ++i) {
        const Vec3& lowest = supports.at[i];
        if (lowest.z() >= 0) continue;
        const Touch touch{lowest, Vec3::UnitZ(), -lowest.z()};
        if (i < Supports::wheels) {
            add_wheel_contact(robot, static_cast<int>(i), touch, supports.forward, nullptr);
        } else {
            add_skid_contact(robot, touch, nullptr);
        }
    }
    Shape hull = model.hull;
    place_hull(hull, model, robot.body);
    if (hull.centre.z() < hull.half_height()) touch_floor_with(hull, robot.body.id, model.firm, hull_friction);
}

// Uses the four lowest corners of a box, or points on the rims of a cylinder.
void Contacts::touch_floor_with(const Shape& shape, dBodyID body, const Spring& spring, double friction) {
    std::array<Vec3, 8> points;
    std::size_t count = 0;
    const Rotation& r = shape.rotation;
    if (shape.kind == Shape::Kind::box) {
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 local{(corner & 1) != 0 ? shape.half.x() : -shape.half.x(),
                             (corner & 2) != 0 ? shape.half.y() : -shape.half.y(),
                             (corner & 4) != 0 ? shape.half.z() : -shape.half.z()};
            points[count++] = shape.centre + rotate(r, local);
        }
    } else {
        // On each rim: the lowest point, and three more at intervals of 90 degrees.
        const Vec3 slope = Vec3::UnitZ() - r.col(2) * r(2, 2);
        const double steep = slope.norm();
        const Vec3 low = steep > 1e-6 ? Vec3(slope * (-1 / steep)) : Vec3(r.col(0));
        const Vec3 side = r.col(2).cross(low);
        for (const double end : {-shape.half.z(), shape.half.z()}) {
            const Vec3 cap = shape.centre + r.col(2) * end;
            for (const Vec3& out : {low, side, Vec3(-side), Vec3(-low)}) points[count++] = cap + out * shape.half.x();
        }
    }
    const auto lower = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
    std::sort(points.begin(), points.end(), lower);
    for (std::size_t i = 0; i < 4 && points[i].z() < 0; ++i) {
        add_contact(body, nullptr, {points[i], Vec3::UnitZ(), -points[i].z()}, spring, friction);
    }
}

void Contacts::touch_neighbours(SimRobot& robot) {
    for (const Scene::Index i : robot.near.fixed) {
        if (!is_full()) touch_fixed(robot, i);
    }
    for (const Scene::Index i : robot.near.movers) {
        if (is_full()) return;
        if (movers_.is_thing(i)) {
            touch_thing(robot, i);
        } else if (i > robot.mover) {  // each pair once
            touch_robot(robot, movers_.robot(i));
        }
    }
}

void Contacts::touch_fixed(SimRobot& robot, Scene::Index index) {
    points_.clear();
    const Shape& shape = scene_.fixed()[index];
    if (distance_from_above(shape, robot.body.p[0], robot.body.p[1]) > robot.model->reach) return;
    bool touches = roll_over(robot, shape, nullptr);
    if (touch_beside(robot, shape, nullptr, robot.model->firm) > 0) touches = true;
    for (const Touch& touch : narrow_.collide(scene_.movers()[robot.mover], shape)) {
        add_contact(robot.body.id, nullptr, touch, robot.model->firm, hull_friction);
        islands_.add_equations(robot.mover, 3);
        touches = true;
    }
    if (touches) meet(robot, {false, index});
}

void Contacts::touch_thing(SimRobot& robot, Scene::Index index) {
    points_.clear();
    Thing& thing = movers_.things[index];
    const Shape& shape = scene_.movers()[index];
    if (distance_from_above(shape, robot.body.p[0], robot.body.p[1]) > robot.model->reach) return;
    bool touches = roll_over(robot, shape, thing.body.id);
    const Spring spring = thing.mass < robot.model->mass ? spring_of(thing) : robot.model->firm;
    if (touch_beside(robot, shape, thing.body.id, spring) > 0) touches = true;
    for (const Touch& touch : narrow_.collide(scene_.movers()[robot.mover], shape)) {
        add_contact(robot.body.id, thing.body.id, touch, spring, hull_friction);
        islands_.add_equations(robot.mover, 3);
        touches = true;
    }
    if (!touches) return;
    meet(robot, {true, index});
    thing.wake();
    islands_.link(robot.mover, index);
}

void Contacts::touch_robot(SimRobot& robot, SimRobot& other) {
    points_.clear();
    const double dx = robot.body.p[0] - other.body.p[0], dy = robot.body.p[1] - other.body.p[1];
    const double far = robot.model->reach + other.model->reach;
    if (dx * dx + dy * dy > far * far) return;
    const RobotModel& lighter = robot.model->mass <= other.model->mass ? *robot.model : *other.model;
    const Shape &hull = scene_.movers()[robot.mover], &other_hull = scene_.movers()[other.mover];
    const auto touches = narrow_.collide(hull, other_hull);
    for (const Touch& touch : touches) add_contact(robot.body.id, other.body.id, touch, lighter.firm, hull_friction);
    islands_.add_equations(robot.mover, 3 * static_cast<int>(touches.size()));
    const int beside = touch_beside(robot, other_hull, other.body.id, lighter.firm) +
                       touch_beside(other, hull, robot.body.id, lighter.firm);
    if (touches.empty() && beside == 0) return;
    meet(robot, {true, other.mover});
    meet(other, {true, robot.mover});
    islands_.link(robot.mover, other.mover);
}

// Adds contacts of wheels and skids with a shape: a kerb, a ramp or a thing on the floor. `other` is its body, or null.
bool Contacts::roll_over(SimRobot& robot, const Shape& shape, dBodyID other) {
    const RobotModel& model = *robot.model;
    const Vec3 centre = robot.body.centre();
    const Rotation rotation = robot.body.rotation();
    bool touches = false;
    // A robot can't roll over a wall, and most near shapes are walls.
    const double top = shape.is_upright() ? shape.centre.z() + shape.half.z() : -nothing;
    for (int side = 0; side < 2; ++side) {
        const Vec3 axle = centre + rotate(rotation, model.wheels[static_cast<std::size_t>(side)]);
        if (top >= axle.z()) continue;
        if (const auto touch = touch_wheel(shape, axle, rotation.col(1), model.wheel_radius)) {
            robot.on_slope = robot.on_slope || is_slope(touch->normal);
            add_wheel_contact(robot, side, *touch, rotation.col(1).cross(touch->normal).normalized(), other);
            touches = true;
        }
    }
    for (const Vec3& skid : model.skids) {
        // The ray begins at the height of the hull's bottom: a higher shape touches the hull before it reaches a skid.
        const Vec3 lowest = centre + rotate(rotation, skid), from = lowest + rotation.col(2) * model.clearance;
        if (top >= from.z()) continue;
        Vec3 normal;
        const double distance = cast_ray(shape, from, -rotation.col(2), model.clearance, &normal);
        if (distance == nothing || distance == 0 || normal.z() < 0.5) continue;
        robot.on_slope = robot.on_slope || is_slope(normal);
        add_skid_contact(robot, {lowest, normal, (model.clearance - distance) * normal.z()}, other);
        touches = true;
    }
    return touches;
}

// Wheels that extend beyond the hull collide with obstacles beside them.
int Contacts::touch_beside(SimRobot& robot, const Shape& shape, dBodyID other, const Spring& spring) {
    const RobotModel& model = *robot.model;
    if (model.wheel_overhang <= 0) return 0;
    const Vec3 centre = robot.body.centre();
    const Rotation rotation = robot.body.rotation();
    int touches = 0;
    for (int side = 0; side < 2; ++side) {
        const Vec3 out = rotation.col(1) * (side == 0 ? 1 : -1);
        const Vec3 wheel = centre + rotate(rotation, model.wheels[static_cast<std::size_t>(side)]);
        // The ray starts as deep within the hull as a wheel can be pushed into an obstacle.
        const double length = 3 * model.wheel_overhang;
        Vec3 normal;
        const double distance = cast_ray(shape, wheel - out * length, out, length, &normal);
        if (distance == nothing || distance == 0 || dot(normal, out) > -0.7) continue;
        add_contact(robot.body.id, other, {wheel, normal, (length - distance) * -dot(normal, out)}, spring,
                    hull_friction);
        ++touches;
    }
    islands_.add_equations(robot.mover, 3 * touches);
    return touches;
}

void Contacts::touch_floor(Thing& thing) {
    const Shape& shape = scene_.movers()[thing.mover];
    if (shape.centre.z() >= shape.half_height()) return;
    touch_floor_with(shape, thing.body.id, spring_of(thing), thing_friction);
}

void Contacts::touch_neighbours(Thing& thing) {
    const Spring spring = spring_of(thing);
    const Shape& shape = scene_.movers()[thing.mover];
    for (const Scene::Index i : thing.near.fixed) {
        if (is_full()) return;
        for (const Touch& touch : narrow_.collide(shape, scene_.fixed()[i])) {
            add_contact(thing.body.id, nullptr, touch, spring, thing_friction);
            islands_.add_equations(thing.mover, 3);
        }
    }
    for (const Scene::Index i : thing.near.movers) {
        if (is_full()) return;
        if (!movers_.is_thing(i)) continue;  // contacts with robots exist already
        Thing& other = movers_.things[i];
        if (!other.asleep && i < thing.mover) continue;  // each pair once
        const auto touches = narrow_.collide(shape, scene_.movers()[i]);
        for (const Touch& touch : touches) add_contact(thing.body.id, other.body.id, touch, spring, thing_friction);
        if (touches.empty()) continue;
        islands_.add_equations(thing.mover, 3 * static_cast<int>(touches.size()));
        if (other.asleep) {
            // Its count of quiet steps is kept, so that two things that rest on each other fall asleep together.
            other.asleep = false;
            dBodyEnable(other.body.id);
        }
        islands_.link(thing.mover, i);
    }
}

}  // namespace nezumi::sim
