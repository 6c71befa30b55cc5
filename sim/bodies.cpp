// Places bodies, wakes them and puts them to sleep.
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
    BodyState state{centre(), rotation(), {}, {velocity(), spin()}};
    std::copy_n(dBodyGetQuaternion(id), 4, state.turn.begin());
    return state;
}

void BodyView::arrive(const BodyState& state) const {
    const auto& [velocity, spin] = state.motion;
    dBodySetPosition(id, state.centre.x(), state.centre.y(), state.centre.z());
    // dBodySetQuaternion would normalize the quaternion again, which changes its last bits. Geoms don't use it.
    std::copy(state.turn.begin(), state.turn.end(), const_cast<dReal*>(dBodyGetQuaternion(id)));
    Eigen::Map<RowMajor3x4>(const_cast<dReal*>(r)).leftCols<3>() = state.rotation;
    dBodySetLinearVel(id, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(id, spin.x(), spin.y(), spin.z());
}

void SimRobot::leave_to_ode(bool solved_by_ode) {
    if (by_ode == solved_by_ode) return;
    by_ode = solved_by_ode;
    by_ode ? dBodyEnable(body.id) : dBodyDisable(body.id);
}

void SimRobot::turn_wheels(double step, int steps) {
    const DriveSpec& drive = model->spec->drive;
    const double by_left = speeds.left * (step / drive.radius_of_left());
    const double by_right = speeds.right * (step / drive.radius_of_right());
    for (int i = 0; i < steps; ++i) {
        angles.left += by_left;
        angles.right += by_right;
    }
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
