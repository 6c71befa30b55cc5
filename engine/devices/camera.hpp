// A camera: a component that publishes pictures at its frame rate, whatever takes them.
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

    /// `open` is called on activation, and again when a parameter has changed. `wait`: the picture exposed at t is
    /// published at t + latency exactly (simulation), else as soon as it is there (hardware). It is stamped with the
    /// time of its exposure.
    Camera(std::string name, CameraMount mount, std::uint64_t seed, Open open, bool wait);

    void sense(const Time& now) override;
    void actuate(const Time& /*now*/) override {}

    /// Why it can't be activated as its parameters are: the tick can't keep its frame rate, or what it would look
    /// through can't be simulated. A real camera may come later. It has its tick rate.
    Expected<void> check() const;

    /// How its parameters set it.
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
    double exposed_at_ = 0;             // [s] the picture that is developed
    DelayedTask<CameraImage> picture_;  // after source_: it works with it
};

/// Makes the component `entry`, a camera whose pictures `open` takes. An error when there is no robot `on` before it,
/// and when it could not be activated as it is configured.
Expected<std::unique_ptr<Component>> make_camera(const ComponentEntry& entry, System& system, Camera::Open open);

/// Makes the component `entry`, a camera in the world of `system`; what `Makers::components` wants for "Camera". Errors
/// as of `make_camera`, and when the system has no world, or the world shows no pictures.
Expected<std::unique_ptr<Component>> make_simulated_camera(const ComponentEntry& entry, System& system);

}  // namespace nezumi
