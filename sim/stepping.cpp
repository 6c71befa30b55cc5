// Advancing the world by fixed steps: contacts, islands, wheels.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/ode_world.hpp"

namespace nezumi::sim {
namespace {

// [m] Neighbours are listed up to this distance, and anew when two could have come so near to each other since.
constexpr double skin = 0.06;

// Bodies that touch each other form an island. `dWorldStep` is exact, and its cost grows with the cube of the equations
// in the island: with 20 (a mouse at a wall) 5 us a robot, 40 (two of them) 11, 60 (three) 28, 80 (four) 74.
// `dWorldQuickStep` iterates and stays at 5. Up to this many equations exactness is worth it.
constexpr int small_island = 45;
constexpr int rows_on_floor = 8;  // of a robot; a thing on its corners has 12

// A thing that has moved no faster than this [m/s, rad/s] for so many steps sleeps until it is touched.
constexpr double quiet_speed = 2e-3, quiet_spin = 2e-2;
constexpr int steps_to_sleep = 60;

}  // namespace

void OdeWorld::step(int count) {
    OdeLibrary::use_on_this_thread();
    const OdeMessages messages(warn_);
    for (SimRobot& robot : robots_) robot.touched = 0;
    if (breakdown_) return;
    try {
        for (int i = 0; i < count; ++i) step_once();
    } catch (const OdeFailure& failure) {
        breakdown_ = Error{failure.text + ": masses, sizes or speeds are beyond what can be simulated", {}};
        return;
    }
    if (sounds_ != nullptr) sounds_->tell();
    restore_lost_bodies();
    place_movers();
    scene_.refresh();
}

void OdeWorld::step_once() {
    if (may_travel_ < 0) list_neighbours();
    place_neighbours();
    links_.clear();
    for (SimRobot& robot : robots_) {
        if (robot.gone) continue;
        touch_floor(robot);
        if (robot.has_neighbours) touch_neighbours(robot);
    }
    for (Thing& thing : things_) {
        if (thing.asleep) continue;
        touch_floor(thing);
        touch_neighbours(thing);
    }
    advance();
    dJointGroupEmpty(contacts_.get());
    turn_wheels();
    tend_things();
}

void OdeWorld::place(const Thing& thing) {
    Shape& shape = scene_.mover(thing.mover);
    shape.centre = thing.body.centre();
    shape.rotation = thing.body.rotation();
}

// All movers to where their bodies are.
void OdeWorld::place_movers() {
    for (const Thing& thing : things_) place(thing);
    for (const SimRobot& robot : robots_) {
        if (!robot.gone) place_hull(scene_.mover(robot.mover), *robot.model, robot.body);
    }
}

// Those that a step looks at.
void OdeWorld::place_neighbours() {
    for (const Thing& thing : things_) {
        rows_[thing.mover] = 0;
        if (!thing.asleep) place(thing);
    }
    for (const SimRobot& robot : robots_) {
        if (!robot.has_neighbours) continue;
        rows_[robot.mover] = 0;
        place_hull(scene_.mover(robot.mover), *robot.model, robot.body);
    }
}

void OdeWorld::list_neighbours() {
    may_travel_ = skin / 2;
    restore_lost_bodies();
    place_movers();
    scene_.refresh();
    const auto list = [&](Neighbours& near, Scene::Index mover, double x, double y, double reach) {
        near.fixed.clear();
        near.movers.clear();
        scene_.for_each_fixed_near(x, y, reach, [&](Scene::Index i, const Shape& shape) {
            if (distance_from_above(shape, x, y) <= reach) near.fixed.push_back(i);
        });
        scene_.for_each_mover_near(x, y, reach, mover, [&](Scene::Index i, const Shape&) { near.movers.push_back(i); });
        // In the order of adding, and each once, whatever the grid looks like.
        std::sort(near.fixed.begin(), near.fixed.end());
        near.fixed.erase(std::unique(near.fixed.begin(), near.fixed.end()), near.fixed.end());
        std::sort(near.movers.begin(), near.movers.end());
        return !near.fixed.empty() || !near.movers.empty();
    };
    for (Thing& thing : things_) {
        list(thing.near, thing.mover, thing.body.p[0], thing.body.p[1], scene_.movers()[thing.mover].reach() + skin);
    }
    for (SimRobot& robot : robots_) {
        robot.has_neighbours =
            !robot.gone && list(robot.near, robot.mover, robot.body.p[0], robot.body.p[1], robot.model->reach + skin);
    }
}

void OdeWorld::advance() {
    if (links_.empty() || !find_large_islands()) {
        dWorldStep(world_.get(), step_);
    } else {
        advance_large_islands();
    }
}

// Fills `large_` by mover. False when no island is large.
bool OdeWorld::find_large_islands() {
    const auto root = [&](Scene::Index i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    };
    std::vector<Scene::Index> linked;
    for (const auto& [a, b] : links_) {
        linked.push_back(a);
        linked.push_back(b);
        const Scene::Index ra = root(a), rb = root(b);
        if (ra != rb) parents_[std::max(ra, rb)] = std::min(ra, rb);
    }
    std::sort(linked.begin(), linked.end());
    linked.erase(std::unique(linked.begin(), linked.end()), linked.end());

    large_.assign(parents_.size(), false);
    std::vector<int> rows(parents_.size(), 0);
    bool any = false;
    for (const Scene::Index i : linked) rows[root(i)] += rows_on_floor + rows_[i];
    for (const Scene::Index i : linked) {
        large_[i] = rows[root(i)] > small_island;
        any = any || large_[i];
    }
    for (const Scene::Index i : linked) parents_[i] = i;
    return any;
}

// Steps the bodies of large islands and all others one after the other: those whose turn it isn't are disabled
// meanwhile. An island is whole in either, so ODE wakes none of them through a joint.
void OdeWorld::advance_large_islands() {
    const auto enable = [&](bool large_ones) {
        const auto set = [](dBodyID body, bool on) { on ? dBodyEnable(body) : dBodyDisable(body); };
        for (const Thing& thing : things_) {
            if (!thing.asleep) set(thing.body.id, large_[thing.mover] == large_ones);
        }
        for (const SimRobot& robot : robots_) {
            if (!robot.gone) set(robot.body.id, large_[robot.mover] == large_ones);
        }
    };
    enable(false);
    dWorldStep(world_.get(), step_);
    enable(true);
    OdeLibrary::with_random_numbers(random_, [&] { dWorldQuickStep(world_.get(), step_); });
    for (const Thing& thing : things_) {
        if (!thing.asleep) dBodyEnable(thing.body.id);
    }
    for (const SimRobot& robot : robots_) {
        if (!robot.gone) dBodyEnable(robot.body.id);
    }
}

// A driven wheel turns as its motor does, whether it grips or slips; a coasting one as the ground under it.
void OdeWorld::turn_wheels() {
    double fastest = 0;  // squared
    bool lost = false;
    const auto look_at = [&](const BodyView& body) {
        const double squared = dot(body.velocity(), body.velocity());
        fastest = std::max(fastest, squared);
        lost = lost || !(squared < 1e6);  // also when it is no number
    };
    for (SimRobot& robot : robots_) {
        look_at(robot.body);
        if (robot.coasting) {
            const Rotation rotation = robot.body.rotation();
            robot.speeds.left = dot(robot.body.velocity_at(rotation * robot.model->wheels[0]), rotation.x);
            robot.speeds.right = dot(robot.body.velocity_at(rotation * robot.model->wheels[1]), rotation.x);
        }
        const double turn = step_ / robot.model->spec->drive.radius;
        robot.angles.left += robot.speeds.left * turn;
        robot.angles.right += robot.speeds.right * turn;
    }
    for (const Thing& thing : things_) look_at(thing.body);
    may_travel_ = lost ? -1 : may_travel_ - std::sqrt(fastest) * step_;
}

void OdeWorld::tend_things() {
    for (Thing& thing : things_) {
        if (thing.asleep) continue;
        const Vec3 velocity = thing.body.velocity(), spin = thing.body.spin();
        const bool quiet =
            dot(velocity, velocity) < quiet_speed * quiet_speed && dot(spin, spin) < quiet_spin * quiet_spin;
        thing.quiet_steps = quiet ? thing.quiet_steps + 1 : 0;
        if (thing.quiet_steps < steps_to_sleep) continue;
        thing.asleep = true;
        dBodySetLinearVel(thing.body.id, 0, 0, 0);
        dBodySetAngularVel(thing.body.id, 0, 0, 0);
        dBodyDisable(thing.body.id);
        // It is not placed again until it wakes.
        place(thing);
    }
}

// A body that the solver has thrown into nowhere goes back to where it was before this call of `step`, at rest.
void OdeWorld::restore_lost_bodies() {
    for (std::size_t i = 0; i < things_.size(); ++i) {
        restore(things_[i].body, scene_.movers()[things_[i].mover], 0, thing_looks_[i].name);
    }
    for (const SimRobot& robot : robots_) {
        restore(robot.body, scene_.movers()[robot.mover], robot.model->hull_drop, robot.name);
    }
}

void OdeWorld::restore(const BodyView& body, const Shape& last, double drop, const std::string& name) {
    if (body.is_sound()) return;
    const Rotation& r = last.rotation;
    const Vec3 centre = last.centre - r.z * drop;
    const dMatrix3 matrix{r.x.x, r.y.x, r.z.x, 0, r.x.y, r.y.y, r.z.y, 0, r.x.z, r.y.z, r.z.z, 0};
    dBodySetPosition(body.id, centre.x, centre.y, centre.z);
    dBodySetRotation(body.id, matrix);
    dBodySetLinearVel(body.id, 0, 0, 0);
    dBodySetAngularVel(body.id, 0, 0, 0);
    warn_("physics: '" + name + "' was lost and is back where it was a tick before");
}

}  // namespace nezumi::sim
