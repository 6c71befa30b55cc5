// A camera in the simulated world.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "engine/world/camera_source.hpp"
#include "engine/world/world.hpp"
#include "sim/distortion.hpp"
#include "sim/image_noise.hpp"
#include "sim/scenery.hpp"

namespace nezumi::sim {

class OdeWorld;

/// Paints walls, boxes, cylinders, markers, the floor and the hulls of the other robots. The robot that carries the
/// camera is not painted.
class SimCamera final : public CameraSource {
public:
    /// `world` must outlive this object. `distortion` comes from the camera's settings, if they have one.
    SimCamera(const OdeWorld& world, std::optional<RobotId> carrier, const CameraMount& mount,
              const CameraSettings& settings, std::shared_ptr<const Distortion> distortion);

    CameraIntrinsics intrinsics() const override { return intrinsics_; }
    std::optional<double> expose(const Time& now) override;
    void develop(CameraImage& image) override;

private:
    const OdeWorld& world_;
    std::optional<RobotId> carrier_;
    View on_carrier_;
    CameraSettings settings_;
    CameraIntrinsics intrinsics_;
    std::shared_ptr<const Distortion> distortion_;  // nullptr: the lens does not distort
    ImageNoise noise_;
    std::vector<std::uint8_t> undistorted_;  // a buffer, kept to avoid allocation
    std::map<int, Picture> tags_;            // by id: the tags that were painted before

    // The exposure:
    Scenery scenery_;
    View view_;
    std::int64_t tick_ = 0;
};

}  // namespace nezumi::sim
