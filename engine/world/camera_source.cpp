// Computes pinhole intrinsics from a field of view.
#include "engine/world/camera_source.hpp"

#include <cmath>

namespace nezumi {

CameraIntrinsics pinhole(int width, int height, double field_of_view) {
    const double focal = width / 2.0 / std::tan(field_of_view / 2);
    return {.width = static_cast<std::uint16_t>(width),
            .height = static_cast<std::uint16_t>(height),
            .fx = focal,
            .fy = focal,
            .cx = (width - 1) / 2.0,
            .cy = (height - 1) / 2.0};
}

CameraIntrinsics CameraSettings::raw_intrinsics() const {
    CameraIntrinsics all = pinhole(width, height, field_of_view);
    if (fx > 0) {
        all.fx = fx;
        all.fy = fy > 0 ? fy : fx;
        all.cx = cx > 0 ? cx : all.cx;
        all.cy = cy > 0 ? cy : all.cy;
    }
    all.k1 = k1;
    all.k2 = k2;
    all.p1 = p1;
    all.p2 = p2;
    all.k3 = k3;
    all.k4 = k4;
    all.k5 = k5;
    all.k6 = k6;
    return all;
}

CameraIntrinsics CameraSettings::intrinsics() const {
    CameraIntrinsics all = raw_intrinsics();
    if (undistort) all.k1 = all.k2 = all.p1 = all.p2 = all.k3 = all.k4 = all.k5 = all.k6 = 0;
    return all;
}

}  // namespace nezumi
