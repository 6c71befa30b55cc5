// In place of jpeg.cpp in a program without simulation, vision and pictures (NEZUMI_SIMULATION=OFF).
#include "bindings/web/jpeg.hpp"

namespace nezumi::web {

Expected<Octets> to_jpeg(const CameraImage& /*picture*/) { return failure("this nezumi is built without pictures"); }

}  // namespace nezumi::web
