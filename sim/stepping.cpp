// Advances the world by fixed steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/ode_world.hpp"

namespace nezumi::sim {
namespace {

// A thing slower than this [m/s, rad/s] for this number of steps sleeps until it is touched.
constexpr double quiet_speed = 2e-3, quiet_spin = 2e-2;
constexpr int steps_to_sleep = 60;

}  // namespace

void OdeWorld::step(int count) {
    OdeLibrary::use_on_this_thread();
    const OdeMessages messages(warn_);
    contacts_.forget_touches();
    if (breakdown_) return;
    publish_signals();
    try {
        for (int left = count; left > 0;) left -= step_together(left);
    } catch (const OdeFailure& failure) {
        breakdown_ = Error{failure.text + ": masses, sizes or speeds are beyond what can be simulated", {}};
        return;
    }
    if (sounds_ != nullptr) sounds_->tell();
    tell_who_left();
    scene_.refresh();
}

// Large wheels can climb the border, and users can push a robot over it.
void OdeWorld::tell_who_left() {
    if (!inside_) return;
    for (SimRobot& robot : movers_.robots) {
        const double x = robot.body.p[0], y = robot.body.p[1];
        if (robot.gone || robot.left || (std::abs(x) <= inside_->x / 2 && std::abs(y) <= inside_->y / 2)) continue;
        robot.left = true;
        warn_(fmt::format("physics: '{}' has left the arena of {:g} x {:g} m, over its border (reported once)",
                          robot.name, inside_->x, inside_->y));
    }
}

// Takes at most `most` steps while the neighbour lists are valid. Returns the number taken.
int OdeWorld::step_together(int most) {
    if (neighbours_.expired()) {
        place_movers();
        scene_.refresh();
        neighbours_.list(scene_, movers_);
    }
    most = neighbours_.steps_left(most);
    ahead_.go(most);
    int taken = 0;
    do step_others(taken++);
    while (taken < most && !neighbours_.expired());
    ahead_.go_back_to(taken);
    settle();
    return taken;
}

// Takes step `index`, counted from 0, for things and for the robots that are not ahead.
void OdeWorld::step_others(int index) {
    place_awake();
    islands_.clear();
    contacts_.find(ahead_.others());
    if (contacts_.is_full())
        warn_("physics: too many shapes overlap: a step has no room for all contacts: some are ignored");
    advance();
    contacts_.clear();
    turn_wheels();
    measure_travel(index);
    tend_things();
}

void OdeWorld::place(const Thing& thing) {
    Shape& shape = scene_.mover(thing.mover);
    shape.centre = thing.body.centre();
    shape.rotation = thing.body.rotation();
}

// Updates the shapes of all movers from their bodies.
void OdeWorld::place_movers() {
    for (const Thing& thing : movers_.things) place(thing);
    for (const SimRobot& robot : movers_.robots) {
        if (!robot.gone) place_hull(scene_.mover(robot.mover), *robot.model, robot.body);
    }
}

// Updates the shapes of awake things, and of robots that may touch something in this step.
void OdeWorld::place_awake() {
    for (const Thing& thing : movers_.things) {
        if (!thing.asleep) place(thing);
    }
    for (const SimRobot* robot : ahead_.others()) {
        if (robot->has_neighbours) place_hull(scene_.mover(robot->mover), *robot->model, robot->body);
    }
}

// Updates the shapes of things and of the robots that were not ahead; the others are already in place.
void OdeWorld::settle() {
    restore_lost_bodies();
    for (const Thing& thing : movers_.things) place(thing);
    for (const SimRobot* robot : ahead_.others()) place_hull(scene_.mover(robot->mover), *robot->model, robot->body);
}

void OdeWorld::advance() {
    if (islands_.find_large()) {
        advance_large_islands();
    } else if (contacts_.any_by_ode()) {
        dWorldStep(world_.get(), step_);
    }
    for (const SimRobot* robot : ahead_.others()) {
        if (robot->by_ode) continue;
        BodyState state = robot->body.state();
        state.advance(robot->next, step_);
        robot->body.arrive(state);
    }
}

// Steps the bodies of large islands and then all others; the other group is disabled meanwhile. An island is in one
// group only, so no joint makes ODE wake a disabled body.
void OdeWorld::advance_large_islands() {
    const auto enable = [&](bool large_ones) {
        const auto set = [](dBodyID body, bool on) { on ? dBodyEnable(body) : dBodyDisable(body); };
        for (const Thing& thing : movers_.things) {
            if (!thing.asleep) set(thing.body.id, islands_.is_large(thing.mover) == large_ones);
        }
        for (const SimRobot* robot : ahead_.others()) {
            if (robot->by_ode) set(robot->body.id, islands_.is_large(robot->mover) == large_ones);
        }
    };
    enable(false);
    dWorldStep(world_.get(), step_);
    enable(true);
    OdeLibrary::with_random_numbers(random_, [&] { dWorldQuickStep(world_.get(), step_); });
    for (const Thing& thing : movers_.things) {
        if (!thing.asleep) dBodyEnable(thing.body.id);
    }
    for (const SimRobot* robot : ahead_.others()) {
        if (robot->by_ode) dBodyEnable(robot->body.id);
    }
}

// A driven wheel turns as its motor does, whether it grips or slips. A coasting wheel turns with the ground.
void OdeWorld::turn_wheels() {
    for (SimRobot* robot : ahead_.others()) {
        if (robot->coasting) {
            const Rotation rotation = robot->body.rotation();
            const auto speed = [&](const Vec3& wheel) {
                return dot(robot->body.velocity_at(rotate(rotation, wheel)), rotation.col(0));
            };
            robot->speeds = {speed(robot->model->wheels[0]), speed(robot->model->wheels[1])};
        }
        robot->turn_wheels(step_);
    }
}

void OdeWorld::measure_travel(int index) {
    double fastest = ahead_.fastest_squared(index);
    bool lost = false;
    const auto look_at = [&](const BodyView& body) {
        const double squared = body.velocity().squaredNorm();
        fastest = std::max(fastest, squared);
        lost = lost || !(squared < 1e6);  // written with `!` so that NaN counts too
    };
    for (const SimRobot* robot : ahead_.others()) look_at(robot->body);
    for (const Thing& thing : movers_.things) look_at(thing.body);
    if (lost) {
        neighbours_.expire();
    } else {
        neighbours_.travel(std::sqrt(fastest) * step_);
    }
}

void OdeWorld::tend_things() {
    for (Thing& thing : movers_.things) {
        if (thing.asleep) continue;
        const Vec3 velocity = thing.body.velocity(), spin = thing.body.spin();
        const bool quiet =
            velocity.squaredNorm() < quiet_speed * quiet_speed && spin.squaredNorm() < quiet_spin * quiet_spin;
        thing.quiet_steps = quiet ? thing.quiet_steps + 1 : 0;
        if (thing.quiet_steps < steps_to_sleep) continue;
        thing.sleep();
        // It stays in place until it wakes.
        place(thing);
    }
}

// If the solver has thrown a body far away, the body returns to its place before this call of `step`, at rest.
void OdeWorld::restore_lost_bodies() {
    for (std::size_t i = 0; i < movers_.things.size(); ++i) {
        restore(movers_.things[i].body, scene_.movers()[movers_.things[i].mover], 0, thing_labels_[i].name);
    }
    for (const SimRobot* robot : ahead_.others())
        restore(robot->body, scene_.movers()[robot->mover], robot->model->hull_drop, robot->name);
}

void OdeWorld::restore(const BodyView& body, const Shape& last, double drop, const std::string& name) {
    if (body.is_sound()) return;
    body.put(last.centre - last.rotation.col(2) * drop, last.rotation);
    warn_("physics: '" + name + "' got an impossible speed and was put back to its place before this tick");
}

}  // namespace nezumi::sim
