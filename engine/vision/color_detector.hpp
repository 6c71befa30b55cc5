// The component that says where a colour is: a picture in, the largest thing of that colour out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/vision/blob.hpp"
#include "engine/vision/image_component.hpp"

namespace nezumi {

/// Colours by hue, saturation and value (Smith, 1978), both ends included.
struct ColorRange {
    double hue_from = 0;         ///< [deg] 0 red, 120 green, 240 blue
    double hue_to = 360;         ///< [deg] below `hue_from`: from there on through red to here
    double saturation_from = 0;  ///< 0 grey
    double saturation_to = 1;    ///< 1 without any white
    double value_from = 0;       ///< 0 black
    double value_to = 1;         ///< 1 the brightest of its hue
};

/// The largest connected part of a picture whose colours are in the range; nothing when there is none. The picture is
/// smoothed by 1 px before. Steps of the hue are 1.4 degrees, of the others 0.004.
std::optional<Blob> find_color(const ColorImage& image, const ColorRange& range);

/// Where in its picture a thing is.
struct ColorSight {
    double left;  ///< its centre: 1 at the left edge, -1 at the right one
    double up;    ///< its centre: 1 at the upper edge, -1 at the lower one
    double area;  ///< share of the picture, up to 1
};

class ColorDetector final : public ImageComponent<std::optional<ColorSight>> {
public:
    /// `wait` as of `ImageComponent`.
    ColorDetector(std::string name, bool wait);
    ~ColorDetector() override { finish(); }  // who looks uses picture_
    ColorDetector(const ColorDetector&) = delete;
    ColorDetector& operator=(const ColorDetector&) = delete;

private:
    Expected<DetectionTask> detection_task(const CameraImage& image) override;
    void publish(const std::optional<ColorSight>& sight) override;

    OutPort<bool>& visible_;
    OutPort<std::vector<double>>& centre_;
    OutPort<double>& area_;
    ColorImage picture_;  // the one that is looked at
};

}  // namespace nezumi
