// Bare ODE loops of the benchmarks' workloads: what the same bodies, contacts and steps cost without anything around
// them.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace nezumi::bench {

/// A robot of the bare loops: one body, two driven wheel contacts, two sprung skids, no response of its own.
struct BareRobotSpec {
    double mass, wheel_radius, track, skid, centre_height;
    bool disc;
    double length, width, height;  ///< a disc: diameter, diameter, height
};

inline constexpr BareRobotSpec bare_mouse{0.72, 0.024, 0.0925, 0.04, 0.04, false, 0.10, 0.08, 0.06};
inline constexpr BareRobotSpec bare_disc{1.6, 0.03, 0.14, 0.07, 0.04, true, 0.17, 0.17, 0.06};

/// A box that stands upright along the axes: all that the bare mouse's rays can meet.
struct BareBox {
    double min_x, max_x, min_y, max_y;
};

/// Distance [m] along a level ray, at most `range`; infinity without a hit.
inline double cast_bare_ray(const BareBox& box, double x, double y, double dx, double dy, double range) {
    double near = 0, far = range;
    const auto clip = [&](double from, double direction, double low, double high) {
        if (direction == 0) {
            if (from < low || from > high) far = -1;
            return;
        }
        const double a = (low - from) / direction, b = (high - from) / direction;
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    };
    clip(x, dx, box.min_x, box.max_x);
    clip(y, dy, box.min_y, box.max_y);
    return near <= far ? near : std::numeric_limits<double>::infinity();
}

/// Where the swarm workload puts robot after robot: at random without overlap, within walls of a square arena.
inline std::vector<std::array<double, 3>> swarm_poses(std::size_t count, double side, unsigned seed = 124) {
    constexpr double radius = 0.085, gap = 0.005;
    std::mt19937 random(seed);
    const auto uniform = [&](double from, double to) {
        return from + (to - from) * (static_cast<double>(random()) / 4294967296.0);  // the same on every machine
    };
    const double limit = side / 2 - radius - gap;
    std::vector<std::array<double, 3>> poses;
    const double cell = 2 * radius + gap;
    const auto columns = static_cast<std::size_t>(side / cell) + 2;
    std::vector<std::vector<std::size_t>> cells(columns * columns);
    while (poses.size() < count) {
        const std::array<double, 3> pose{uniform(-limit, limit), uniform(-limit, limit),
                                         uniform(-std::numbers::pi, std::numbers::pi)};
        const auto column = static_cast<std::size_t>((pose[0] + side / 2) / cell);
        const auto row = static_cast<std::size_t>((pose[1] + side / 2) / cell);
        bool free = true;
        for (std::size_t c = column == 0 ? 0 : column - 1; c <= column + 1 && c < columns; ++c) {
            for (std::size_t r = row == 0 ? 0 : row - 1; r <= row + 1 && r < columns; ++r) {
                for (const std::size_t i : cells[c * columns + r]) {
                    free = free && std::hypot(poses[i][0] - pose[0], poses[i][1] - pose[1]) > cell;
                }
            }
        }
        if (!free) continue;
        cells[column * columns + row].push_back(poses.size());
        poses.push_back(pose);
    }
    return poses;
}

/// The side of the swarm's arena [m], border to border, for the counts of the workload.
inline double swarm_side(std::size_t count) { return count <= 10 ? 4 : count <= 100 ? 10 : count <= 1000 ? 32 : 100; }

class BareLoop {
public:
    BareLoop(const BareRobotSpec& spec, double step) : spec_(spec), step_(step) {
        dInitODE2(0);
        dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
        world_ = dWorldCreate();
        contacts_ = dJointGroupCreate(0);
        dWorldSetGravity(world_, 0, 0, -9.81);
        const double stiffness = 18'750 * spec.mass, damping = 437.5 * spec.mass;
        firm_ = {step * stiffness / (step * stiffness + damping), 1 / (step * stiffness + damping)};
        const double soft = 940 * spec.mass, soft_damping = 41.9 * spec.mass;
        soft_ = {step * soft / (step * soft + soft_damping), 1 / (step * soft + soft_damping)};
    }
    ~BareLoop() {
        dJointGroupDestroy(contacts_);
        dWorldDestroy(world_);
        dCloseODE();
    }
    BareLoop(const BareLoop&) = delete;
    BareLoop& operator=(const BareLoop&) = delete;

    void add(double x, double y, double heading) {
        const dBodyID body = dBodyCreate(world_);
        dMass mass;
        if (spec_.disc) {
            dMassSetCylinderTotal(&mass, spec_.mass, 3, spec_.length / 2, spec_.height);
        } else {
            dMassSetBoxTotal(&mass, spec_.mass, spec_.length, spec_.width, spec_.height);
        }
        dBodySetMass(body, &mass);
        dBodySetGyroscopicMode(body, 0);
        dBodySetPosition(body, x, y, spec_.centre_height);
        dMatrix3 rotation;
        dRFromAxisAndAngle(rotation, 0, 0, 1, heading);
        dBodySetRotation(body, rotation);
        bodies_.push_back({body, 0, 0});
    }

    void drive(std::size_t robot, double left, double right) {
        bodies_[robot].left = left;
        bodies_[robot].right = right;
    }

    /// One physics step of all robots on the floor. They don't meet: nothing but wheels and skids has contacts.
    void step() {
        for (const Body& body : bodies_) {
            const dReal* r = dBodyGetRotation(body.id);
            add_wheel(body.id, 0.5 * spec_.track, body.left, r);
            add_wheel(body.id, -0.5 * spec_.track, body.right, r);
            add_skid(body.id, spec_.skid);
            add_skid(body.id, -spec_.skid);
        }
        dWorldStep(world_, step_);
        dJointGroupEmpty(contacts_);
    }

    /// What the mouse's four infrared rays of 0.6 m see of these boxes.
    std::array<double, 4> cast_mouse_rays(std::size_t robot, const std::vector<BareBox>& boxes) const {
        static constexpr double half = 0.70710678118654752;
        static constexpr std::array<std::array<double, 4>, 4> rays{
            {{0.035, -0.040, 1, 0}, {0.045, -0.030, half, -half}, {0.045, 0.030, half, half}, {0.035, 0.040, 1, 0}}};
        const dReal *p = position(robot), *r = rotation(robot);
        std::array<double, 4> seen{};
        for (std::size_t i = 0; i < 4; ++i) {
            seen[i] = std::numeric_limits<double>::infinity();
            const auto& [x, y, dx, dy] = rays[i];
            for (const BareBox& box : boxes) {
                seen[i] = std::min(seen[i], cast_bare_ray(box, p[0] + r[0] * x + r[1] * y, p[1] + r[4] * x + r[5] * y,
                                                          r[0] * dx + r[1] * dy, r[4] * dx + r[5] * dy, 0.6));
            }
        }
        return seen;
    }

    const dReal* position(std::size_t robot) const { return dBodyGetPosition(bodies_[robot].id); }
    const dReal* rotation(std::size_t robot) const { return dBodyGetRotation(bodies_[robot].id); }

private:
    struct Body {
        dBodyID id;
        double left, right;
    };
    struct Spring {
        double erp, cfm;
    };

    void add_wheel(dBodyID body, double y, double speed, const dReal* r) {
        dVector3 at;
        dBodyGetRelPointPos(body, 0, y, -spec_.centre_height - 0.000183, at);
        if (at[2] >= 0) return;
        dContact contact{};
        contact.surface.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1 | dContactFDir1 | dContactMotion1 |
                               dContactSlip1 | dContactSlip2;
        contact.surface.mu = 1.0;
        contact.surface.soft_erp = firm_.erp;
        contact.surface.soft_cfm = firm_.cfm;
        contact.surface.slip1 = contact.surface.slip2 = 8e-4 / spec_.mass;
        contact.surface.motion1 = speed;
        contact.fdir1[0] = r[0];
        contact.fdir1[1] = r[4];
        attach(contact, at, body);
    }

    void add_skid(dBodyID body, double x) {
        dVector3 at;
        dBodyGetRelPointPos(body, x, 0, -spec_.centre_height - 0.00157, at);
        if (at[2] >= 0) return;
        dContact contact{};
        contact.surface.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
        contact.surface.soft_erp = soft_.erp;
        contact.surface.soft_cfm = soft_.cfm;
        attach(contact, at, body);
    }

    void attach(dContact& contact, const dReal* at, dBodyID body) {
        contact.geom.pos[0] = at[0];
        contact.geom.pos[1] = at[1];
        contact.geom.pos[2] = at[2];
        contact.geom.normal[2] = 1;
        contact.geom.depth = -at[2];
        dJointAttach(dJointCreateContact(world_, contacts_, &contact), body, nullptr);
    }

    BareRobotSpec spec_;
    double step_;
    dWorldID world_ = nullptr;
    dJointGroupID contacts_ = nullptr;
    Spring firm_{}, soft_{};
    std::vector<Body> bodies_;
};

}  // namespace nezumi::bench
