// Rotations about an axis, written out: an axis-angle formula does not give exact zeros and ones.
#include "sim/geometry.hpp"

#include <cmath>

namespace nezumi::sim {

Rotation yaw_rotation(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    Rotation r;
    r << c, -s, 0, s, c, 0, 0, 0, 1;
    return r;
}

Rotation yaw_pitch_rotation(double yaw_angle, double pitch_angle) {
    const double c = std::cos(pitch_angle), s = std::sin(pitch_angle);
    Rotation pitch;
    pitch << c, 0, s, 0, 1, 0, -s, 0, c;
    return yaw_rotation(yaw_angle) * pitch;
}

Rotation rotation_of(const Orientation3D& orientation) {
    const double c = std::cos(orientation.r), s = std::sin(orientation.r);
    Rotation roll;
    roll << 1, 0, 0, 0, c, -s, 0, s, c;
    return yaw_pitch_rotation(orientation.y, orientation.p) * roll;
}

}  // namespace nezumi::sim
