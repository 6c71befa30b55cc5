// Placing, waking and putting to sleep.
#include "sim/bodies.hpp"

namespace nezumi::sim {

void BodyView::put(const Vec3& centre, const Rotation& rotation) const {
    RowMajor3x4 matrix = RowMajor3x4::Zero();
    matrix.leftCols<3>() = rotation;
    dBodySetPosition(id, centre.x(), centre.y(), centre.z());
    dBodySetRotation(id, matrix.data());
    dBodySetLinearVel(id, 0, 0, 0);
    dBodySetAngularVel(id, 0, 0, 0);
}

void BodyView::advance(const Motion& motion, double step) const {
    const auto& [velocity, spin] = motion;
    const Vec3 to = centre() + velocity * step;
    dBodySetPosition(id, to.x(), to.y(), to.z());
    const dReal* const q = dBodyGetQuaternion(id);
    const Vec3 along{q[1], q[2], q[3]}, turned = along + (spin * q[0] + spin.cross(along)) * (step / 2);
    const dQuaternion next{q[0] - spin.dot(along) * (step / 2), turned.x(), turned.y(), turned.z()};
    dBodySetQuaternion(id, next);  // which also makes it of length 1
    dBodySetLinearVel(id, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(id, spin.x(), spin.y(), spin.z());
}

void SimRobot::leave_to_ode(bool solved_by_ode) {
    if (by_ode == solved_by_ode) return;
    by_ode = solved_by_ode;
    by_ode ? dBodyEnable(body.id) : dBodyDisable(body.id);
}

void Thing::wake() {
    quiet_steps = 0;
    if (!asleep) return;
    asleep = false;
    dBodyEnable(body.id);
}

void Thing::sleep() {
    asleep = true;
    dBodySetLinearVel(body.id, 0, 0, 0);
    dBodySetAngularVel(body.id, 0, 0, 0);
    dBodyDisable(body.id);
}

}  // namespace nezumi::sim
