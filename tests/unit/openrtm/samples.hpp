// A message of every type that OpenRTM knows, with no field at its zero.
#pragma once

#include <vector>

#include "engine/ports/messages.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

inline std::vector<Value> samples() {
    const Pose3D pose{{1, 2, 3}, {0.1, 0.2, 0.3}};
    const Size3D size{0.1, 0.2, 0.3};
    return {true,
            std::int16_t{-300},
            std::int32_t{70000},
            0.5F,
            0.1,
            std::string("text"),
            std::vector<bool>{true, false, true},
            std::vector<std::int16_t>{1, -2, 3},
            std::vector<std::int32_t>{100000, -2},
            std::vector<float>{0.5F, -0.25F},
            std::vector<double>{0.1, -2},
            std::vector<std::string>{"a", "", "b c"},
            Velocity2D{0.1, 0.2, -0.3},
            Pose2D{{1, -2}, 0.5},
            pose,
            RangeData{{0.5, 1.5}, {pose, size, {{pose, size}}}, {-1, 1, 0.1, 0.02, 4, 0.01, 10}},
            CameraImage{2, 1, 24, "rgb8", 0.5, {1, 2, 3, 4, 5, 6}}};
}

}  // namespace nezumi
