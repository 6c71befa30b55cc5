// Replaces the cameras in a program without OpenCV by an error.
#include "sim/ode_world.hpp"

namespace nezumi::sim {

Expected<std::unique_ptr<CameraSource>> OdeWorld::open_camera(const CameraMount& /*mount*/,
                                                              const CameraSettings& /*settings*/) {
    return failure("this build of nezumi has no cameras");
}

}  // namespace nezumi::sim
