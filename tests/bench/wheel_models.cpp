// Compares two wheel models in bare ODE: hinged wheel bodies against one body whose wheels are moving contacts.
//
// Both robots have the same mass, wheels, sprung skids and floor contacts, all computed rather than collided, so that
// the difference is the model's alone. Result (two shared cores, ODE 0.16.2): the hinged model costs 2.4 to 2.6 times
// as much a step, for three bodies and two motors more in the solver, and drives no better: both reach the commanded
// speed exactly, both slip when blocked. That is why sim/ builds robots from one body. Figures are ratios from one run.
#include <ode/ode.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/bench/report.hpp"

namespace {

constexpr double robot_mass = 1.6, hull_radius = 0.085, hull_height = 0.06, hull_centre = 0.04;
constexpr double wheel_radius = 0.03, track = 0.14, wheel_mass = 0.05, skid_x = 0.06;
constexpr double time_step = 0.01;

struct Robot {
    dBodyID body = nullptr;
    dBodyID wheels[2] = {};
    dJointID motors[2] = {};
    double speed[2] = {0.2, 0.3};
};

struct Bench {
    dWorldID world = dWorldCreate();
    dJointGroupID contacts = dJointGroupCreate(0);
    std::vector<Robot> robots;

    Bench() { dWorldSetGravity(world, 0, 0, -9.81); }
    ~Bench() {
        dJointGroupDestroy(contacts);
        dWorldDestroy(world);
    }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    void add_contact(dBodyID body, const double* at, double depth, int mode, double mu, double erp, double cfm,
                     const double* direction, double motion) {
        dContact contact{};
        contact.surface.mode = mode | dContactSoftERP | dContactSoftCFM | dContactApprox1;
        contact.surface.mu = mu;
        contact.surface.soft_erp = erp;
        contact.surface.soft_cfm = cfm;
        contact.surface.slip1 = contact.surface.slip2 = 5e-4;
        contact.surface.motion1 = motion;
        contact.geom.depth = depth;
        contact.geom.normal[2] = 1;
        for (int i = 0; i < 3; ++i) contact.geom.pos[i] = at[i];
        if (direction != nullptr) {
            for (int i = 0; i < 3; ++i) contact.fdir1[i] = direction[i];
        }
        dJointAttach(dJointCreateContact(world, contacts, &contact), body, nullptr);
    }

    void add_skids(dBodyID body) {
        for (const double x : {skid_x, -skid_x}) {
            dVector3 at;
            dBodyGetRelPointPos(body, x, 0, -hull_centre - 0.00157, at);
            if (at[2] < 0) add_contact(body, at, -at[2], 0, 0, 0.183, 0.0122, nullptr, 0);
        }
    }
};

dBodyID make_chassis(dWorldID world, double x, double y, double mass) {
    dBodyID body = dBodyCreate(world);
    dMass m;
    dMassSetCylinderTotal(&m, mass, 3, hull_radius, hull_height);
    dBodySetMass(body, &m);
    dBodySetPosition(body, x, y, hull_centre);
    return body;
}

void build_contact_robot(Bench& bench, double x, double y) {
    Robot robot;
    robot.body = make_chassis(bench.world, x, y, robot_mass);
    bench.robots.push_back(robot);
}

void step_contact_robots(Bench& bench) {
    for (const Robot& robot : bench.robots) {
        const double* r = dBodyGetRotation(robot.body);
        for (int side = 0; side < 2; ++side) {
            dVector3 at;
            dBodyGetRelPointPos(robot.body, 0, (side == 0 ? 0.5 : -0.5) * track, -hull_centre, at);
            const double forward[3] = {r[0], r[4], 0};
            const double depth = at[2] < 0 ? -at[2] : 0;
            bench.add_contact(robot.body, at, depth, dContactFDir1 | dContactMotion1 | dContactSlip1 | dContactSlip2,
                              1.0, 0.3, 1e-3, forward, robot.speed[side]);
        }
        bench.add_skids(robot.body);
    }
    dWorldStep(bench.world, time_step);
    dJointGroupEmpty(bench.contacts);
}

void build_hinge_robot(Bench& bench, double x, double y) {
    Robot robot;
    robot.body = make_chassis(bench.world, x, y, robot_mass - 2 * wheel_mass);
    for (int side = 0; side < 2; ++side) {
        robot.wheels[side] = dBodyCreate(bench.world);
        dMass m;
        dMassSetCylinderTotal(&m, wheel_mass, 2, wheel_radius, 0.01);
        dBodySetMass(robot.wheels[side], &m);
        dBodySetPosition(robot.wheels[side], x, y + (side == 0 ? 0.5 : -0.5) * track, wheel_radius);
        robot.motors[side] = dJointCreateHinge(bench.world, nullptr);
        dJointAttach(robot.motors[side], robot.body, robot.wheels[side]);
        dJointSetHingeAnchor(robot.motors[side], x, y + (side == 0 ? 0.5 : -0.5) * track, wheel_radius);
        dJointSetHingeAxis(robot.motors[side], 0, -1, 0);
        dJointSetHingeParam(robot.motors[side], dParamFMax, 0.2);
    }
    bench.robots.push_back(robot);
}

void step_hinge_robots(Bench& bench) {
    for (const Robot& robot : bench.robots) {
        const double* r = dBodyGetRotation(robot.body);
        for (int side = 0; side < 2; ++side) {
            dJointSetHingeParam(robot.motors[side], dParamVel, robot.speed[side] / wheel_radius);
            const double* p = dBodyGetPosition(robot.wheels[side]);
            const double at[3] = {p[0], p[1], p[2] - wheel_radius};
            const double forward[3] = {r[0], r[4], 0};
            const double depth = at[2] < 0 ? -at[2] : 0;
            bench.add_contact(robot.wheels[side], at, depth, dContactFDir1 | dContactSlip1 | dContactSlip2, 1.0, 0.3,
                              1e-3, forward, 0);
        }
        bench.add_skids(robot.body);
    }
    dWorldStep(bench.world, time_step);
    dJointGroupEmpty(bench.contacts);
}

struct Result {
    double microseconds_a_step;
    double speed;  // m/s of the first robot's chassis
};

template <class Build, class Step>
Result measure(int count, int steps, Build build, Step step) {
    Bench bench;
    for (int i = 0; i < count; ++i) build(bench, (i % 10) * 2.0, (i / 10) * 2.0);
    for (int i = 0; i < 300; ++i) step(bench);  // come up to speed
    const double begin = nezumi::bench::thread_seconds();
    for (int i = 0; i < steps; ++i) step(bench);
    const double took = nezumi::bench::thread_seconds() - begin;
    const double* v = dBodyGetLinearVel(bench.robots[0].body);
    return {took * 1e6 / steps / count, std::hypot(v[0], v[1])};
}

}  // namespace

int main() {
    nezumi::bench::print_header(
        "wheel models: hinged wheels against contacts that move",
        "ODE dWorldStep, step 10 ms, wheels commanded 0.2 and 0.3 m/s (0.25 m/s at the chassis)");
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    std::printf("%8s %14s %14s %8s %14s %14s\n", "robots", "hinge us/step", "contact us/step", "ratio", "hinge m/s",
                "contact m/s");
    for (const int count : {1, 10, 100}) {
        const int steps = 100000 / count;
        const Result hinge = measure(count, steps, build_hinge_robot, step_hinge_robots);
        const Result contact = measure(count, steps, build_contact_robot, step_contact_robots);
        std::printf("%8d %14.2f %14.2f %8.2f %14.5f %14.5f\n", count, hinge.microseconds_a_step,
                    contact.microseconds_a_step, hinge.microseconds_a_step / contact.microseconds_a_step, hinge.speed,
                    contact.speed);
    }
    dCloseODE();
}
