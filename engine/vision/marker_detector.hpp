// The component that finds markers: its input is a picture, its outputs the poses of markers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/vision/image_component.hpp"
#include "engine/vision/tag_finder.hpp"

namespace nezumi {

class MarkerDetector final : public ImageComponent<std::vector<SeenMarker>> {
public:
    /// `wait` as in `ImageComponent`.
    MarkerDetector(std::string name, bool wait);
    ~MarkerDetector() override { finish(); }  // the detection uses finder_ and picture_

private:
    Expected<DetectionTask> detection_task(const CameraImage& image) override;
    void publish(const std::vector<SeenMarker>& seen) override;
    Expected<CameraIntrinsics> intrinsics_for(const GrayImage& image);
    /// Reports once which properties of the camera are unknown, and the values used instead.
    void tell_unknown(std::string what);

    InPort<CameraIntrinsics>& intrinsics_;
    OutPort<Pose3D>& pos_;
    OutPort<bool>& visible_;
    OutPort<std::int32_t>& id_;
    OutPort<std::vector<SeenMarker>>& markers_;
    GrayImage picture_;  // the picture being searched
    std::optional<TagFinder> finder_;
    std::string family_;
    std::string told_;  // the last report of `tell_unknown`
};

}  // namespace nezumi
