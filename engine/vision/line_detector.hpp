// The component that says where a line on the floor is: a picture in, how far off it is and which way it runs out.
#pragma once

#include <optional>
#include <string>

#include "engine/vision/blob.hpp"
#include "engine/vision/image_component.hpp"

namespace nezumi {

/// What a line looks like, and where in the picture it may be.
struct LineSettings {
    bool dark = true;       ///< on a lighter floor; else light on a darker one
    double contrast = 0.3;  ///< least difference of its mean grey from the floor's: 1 is black against white
    double top = 0.5;       ///< where the part of the picture begins that is looked at, as a share of its height
};

/// The largest connected part of a picture that differs so from the rest (Otsu, 1979); nothing when there is none. The
/// picture is smoothed by 1.5 px before.
std::optional<Blob> find_line(const GrayImage& image, const LineSettings& settings);

/// Where in its picture a line is.
struct LineSight {
    double offset;  ///< its centre: 1 at the left edge, -1 at the right one
    double angle;   ///< [rad] 0 upright, positive leaning to the left, -pi/2 to pi/2
};

class LineDetector final : public ImageComponent<std::optional<LineSight>> {
public:
    /// `wait` as of `ImageComponent`.
    LineDetector(std::string name, bool wait);
    ~LineDetector() override { finish(); }  // who looks uses picture_
    LineDetector(const LineDetector&) = delete;
    LineDetector& operator=(const LineDetector&) = delete;

private:
    Expected<DetectionTask> detection_task(const CameraImage& image) override;
    void publish(const std::optional<LineSight>& sight) override;

    OutPort<bool>& visible_;
    OutPort<double>& offset_;
    OutPort<double>& angle_;
    GrayImage picture_;  // the one that is looked at
};

}  // namespace nezumi
