// A component that publishes pictures of a camera at its frame rate.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "engine/components/component.hpp"
#include "engine/components/delayed_task.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/world/camera_source.hpp"

namespace nezumi {

class System;

class Camera final : public Device {
public:
    using Open = std::function<Expected<std::unique_ptr<CameraSource>>(const CameraMount&, const CameraSettings&)>;

    /// `open` is called on activation, and again after a parameter has changed. `wait`: the picture exposed at t is
    /// published at exactly t + latency (simulation), otherwise as soon as it is available (hardware). Its time stamp
    /// is the time of its exposure.
    Camera(std::string name, CameraMount mount, std::uint64_t seed, Open open, bool wait);

    void sense(const Time& now) override;
    void actuate(const Time& /*now*/) override {}

    /// Checks whether the camera can be activated with its parameters: an error if the tick rate is too low for its
    /// frame rate, or if its distortion can't be simulated. A real camera may be connected later. The tick rate must be
    /// set before.
    Expected<void> check() const;

    /// The settings that the parameters give.
    CameraSettings settings() const;

private:
    Expected<void> on_activated() override;
    Expected<void> on_deactivated() override;
    Expected<void> check_frame_rate() const;
    Expected<std::unique_ptr<CameraSource>> make_source() const;
    Expected<void> open();
    void take_picture(const Time& now);
    void look_at_device(const Time& now);
    void publish_intrinsics();

    CameraMount mount_;
    std::uint64_t seed_;
    Open open_;
    bool wait_;
    OutPort<CameraImage>& out_;
    OutPort<CameraIntrinsics>& intrinsics_;
    std::unique_ptr<CameraSource> source_;
    std::uint64_t parameters_version_ = 0;
    double frame_rate_ = 0;
    double latency_ = 0;
    double exposed_at_ = 0;             // [s] of the picture that is being developed
    DelayedTask<CameraImage> picture_;  // declared after source_, which it uses
};

/// Makes the component `entry`, a camera with pictures from `open`. An error if the robot `on` does not exist yet, or
/// if the camera could not be activated.
Expected<std::unique_ptr<Component>> make_camera(const ComponentEntry& entry, System& system, Camera::Open open);

/// Makes the component `entry`, a camera in the world of `system`, for `Makers::components` ("Camera"). Errors as in
/// `make_camera`, and if the system has no world, or the world can't be seen.
Expected<std::unique_ptr<Component>> make_simulated_camera(const ComponentEntry& entry, System& system);

}  // namespace nezumi
