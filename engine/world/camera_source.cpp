// The pinhole of a field of view.
#include "engine/world/camera_source.hpp"

#include <cmath>

namespace nezumi {

Intrinsics Intrinsics::of(int width, int height, double field_of_view) {
    const double focal = width / 2.0 / std::tan(field_of_view / 2);
    return {.fx = focal, .fy = focal, .cx = (width - 1) / 2.0, .cy = (height - 1) / 2.0};
}

}  // namespace nezumi
