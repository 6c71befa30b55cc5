// Placing, waking and putting to sleep.
#include "sim/bodies.hpp"

#include <algorithm>

namespace nezumi::sim {

void BodyView::put(const Vec3& centre, const Rotation& rotation) const {
    RowMajor3x4 matrix = RowMajor3x4::Zero();
    matrix.leftCols<3>() = rotation;
    dBodySetPosition(id, centre.x(), centre.y(), centre.z());
    dBodySetRotation(id, matrix.data());
    dBodySetLinearVel(id, 0, 0, 0);
    dBodySetAngularVel(id, 0, 0, 0);
}

BodyState BodyView::state() const {
    BodyState state{centre(), rotation(), {}, {}, {velocity(), spin()}};
    std::copy_n(dBodyGetQuaternion(id), 4, state.turn);
    return state;
}

void BodyView::arrive(const BodyState& state) const {
    const auto& [velocity, spin] = state.motion;
    dBodySetPosition(id, state.centre.x(), state.centre.y(), state.centre.z());
    dBodySetQuaternion(id, state.given);
    dBodySetLinearVel(id, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(id, spin.x(), spin.y(), spin.z());
}

void BodyState::advance(const Motion& how, double step) {
    motion = how;
    const auto& [velocity, spin] = motion;
    centre += velocity * step;
    const Vec3 along{turn[1], turn[2], turn[3]}, turned = along + (spin * turn[0] + spin.cross(along)) * (step / 2);
    given[0] = turn[0] - spin.dot(along) * (step / 2);
    for (int i = 0; i < 3; ++i) given[i + 1] = turned[i];
    std::copy_n(given, 4, turn);
    dNormalize4(turn);
    RowMajor3x4 matrix;
    dQtoR(turn, matrix.data());
    rotation = matrix.leftCols<3>();
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
