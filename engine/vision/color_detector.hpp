// The component that finds a colour: its input is a picture, its output the largest object of that colour.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/vision/blob.hpp"
#include "engine/vision/image_component.hpp"

namespace nezumi {

/// Colours by hue, saturation and value (Smith, 1978); both limits are included.
struct ColorRange {
    double hue_from = 0;         ///< [deg] 0 red, 120 green, 240 blue
    double hue_to = 360;         ///< [deg] if below `hue_from`: the range goes through red
    double saturation_from = 0;  ///< 0 grey
    double saturation_to = 1;    ///< 1 without any white
    double value_from = 0;       ///< 0 black
    double value_to = 1;         ///< 1 brightest of its hue
};

/// Returns the largest connected region whose colours are in the range; nothing if there is none. The picture is
/// smoothed by 1 px first. The resolution is 1.4 degrees for the hue and 0.004 for the others.
std::optional<Blob> find_color(const ColorImage& image, const ColorRange& range);

/// The position of an object in its picture.
struct ColorSight {
    double left;  ///< of its centre: 1 at the left edge, -1 at the right one
    double up;    ///< of its centre: 1 at the upper edge, -1 at the lower one
    double area;  ///< its part of the picture, up to 1
};

class ColorDetector final : public ImageComponent<std::optional<ColorSight>> {
public:
    /// `wait` as in `ImageComponent`.
    ColorDetector(std::string name, bool wait);
    ~ColorDetector() override { finish(); }  // the detection uses picture_
    ColorDetector(const ColorDetector&) = delete;
    ColorDetector& operator=(const ColorDetector&) = delete;

private:
    Expected<DetectionTask> detection_task(const CameraImage& image) override;
    void publish(const std::optional<ColorSight>& sight) override;

    OutPort<bool>& visible_;
    OutPort<std::vector<double>>& centre_;
    OutPort<double>& area_;
    ColorImage picture_;  // the picture being searched
};

}  // namespace nezumi
