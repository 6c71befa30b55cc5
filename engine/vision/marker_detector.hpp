// The component that says where a marker is: a picture in, a pose out.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/components/component.hpp"
#include "engine/components/delayed_task.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/vision/tag_finder.hpp"

namespace nezumi {

class System;

/// What a picture told.
struct MarkerSight {
    std::optional<FoundTag> tag;  ///< none in sight
    std::string complaint;        ///< why it is no picture; "" when it is one
};

class MarkerDetector final : public Component {
public:
    /// What is searched.
    struct Picture {
        GrayImage gray;
        CameraIntrinsics intrinsics;
    };

    /// `wait`: what was seen in the picture of t is published at t + latency exactly (simulation), else as soon as it
    /// is known (hardware).
    MarkerDetector(std::string name, bool wait);

    InPortBase& image_port() { return image_; }

private:
    Expected<void> on_activated() override;
    Expected<void> on_execute() override;
    Expected<void> on_deactivated() override;
    Expected<CameraIntrinsics> intrinsics_for(const GrayImage& image) const;
    Expected<Picture> picture();
    void start();
    Expected<void> take_sight();
    void publish(const MarkerSight& sight);

    bool wait_;
    InPort<CameraImage>& image_;
    InPort<CameraIntrinsics>& intrinsics_;
    OutPort<Pose3D>& pos_;
    OutPort<bool>& visible_;
    OutPort<std::int32_t>& id_;
    std::optional<TagFinder> finder_;
    std::string family_;
    bool complained_ = false;
    DelayedTask<MarkerSight> sight_;  // after finder_: it works with it
};

/// Makes the component `entry`; what `Makers::components` wants for "MarkerDetector" in a simulation. An error when it
/// has an `on`.
Expected<std::unique_ptr<Component>> make_marker_detector(const ComponentEntry& entry, System& system);

}  // namespace nezumi
