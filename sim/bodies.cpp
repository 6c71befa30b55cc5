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
