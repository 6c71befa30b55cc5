// Placing, waking and putting to sleep.
#include "sim/bodies.hpp"

namespace nezumi::sim {

void BodyView::put(const Vec3& centre, const Rotation& rotation) const {
    const Rotation& m = rotation;
    const dMatrix3 matrix{m.x.x, m.y.x, m.z.x, 0, m.x.y, m.y.y, m.z.y, 0, m.x.z, m.y.z, m.z.z, 0};
    dBodySetPosition(id, centre.x, centre.y, centre.z);
    dBodySetRotation(id, matrix);
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
