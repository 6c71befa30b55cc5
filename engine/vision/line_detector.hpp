// The component that finds a line on the floor: its input is a picture, its outputs the line's offset and angle.
#pragma once

#include <optional>
#include <string>

#include "engine/vision/blob.hpp"
#include "engine/vision/image_component.hpp"

namespace nezumi {

/// The appearance of a line, and the searched part of the picture.
struct LineSettings {
    bool dark = true;       ///< on a lighter floor; if false, light on a darker floor
    double contrast = 0.3;  ///< smallest difference of the mean grey values of line and floor: 1 is black against white
    double top = 0.5;       ///< top of the searched part of the picture, relative to its height
};

/// Returns the largest connected region that differs enough from the rest (Otsu, 1979); nothing if there is none. The
/// picture is smoothed by 1.5 px first.
std::optional<Blob> find_line(const GrayImage& image, const LineSettings& settings);

/// The position of a line in its picture.
struct LineSight {
    double offset;  ///< of its centre: 1 at the left edge, -1 at the right one
    double angle;   ///< [rad] 0 vertical, positive if it leans to the left, -pi/2 to pi/2
};

class LineDetector final : public ImageComponent<std::optional<LineSight>> {
public:
    /// `wait` as in `ImageComponent`.
    LineDetector(std::string name, bool wait);
    ~LineDetector() override { finish(); }  // the detection uses picture_
    LineDetector(const LineDetector&) = delete;
    LineDetector& operator=(const LineDetector&) = delete;

private:
    Expected<DetectionTask> detection_task(const CameraImage& image) override;
    void publish(const std::optional<LineSight>& sight) override;

    OutPort<bool>& visible_;
    OutPort<double>& offset_;
    OutPort<double>& angle_;
    GrayImage picture_;  // the picture being searched
};

}  // namespace nezumi
