// Converts colours to hues, marks those in the range, and takes the largest connected region.
#include "engine/vision/color_detector.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "engine/vision/one_thread.hpp"

namespace nezumi {
namespace {

// [px] Smoothing, because noise makes holes in an object and spots elsewhere.
constexpr double smoothing = 1;
// OpenCV's hues with 8 bits: a full circle.
constexpr int hues = 256;
constexpr double degrees_round = 360, brightest = 255;

}  // namespace

std::optional<Blob> find_color(const ColorImage& image, const ColorRange& range) {
    // cv::Mat has no constructor for const data; this one is only read.
    const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat hsv;
    cv::GaussianBlur(rgb, hsv, {}, smoothing);
    cv::cvtColor(hsv, hsv, cv::COLOR_RGB2HSV_FULL);

    GrayImage mask{image.width, image.height, {}};
    mask.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    cv::Mat marked(image.height, image.width, CV_8UC1, mask.pixels.data());
    const auto mark = [&](double hue_from, double hue_to, cv::Mat& where) {
        cv::inRange(
            hsv,
            cv::Scalar(hue_from, std::round(range.saturation_from * brightest),
                       std::round(range.value_from * brightest)),
            cv::Scalar(hue_to, std::round(range.saturation_to * brightest), std::round(range.value_to * brightest)),
            where);
    };
    const double from = std::round(range.hue_from * hues / degrees_round);
    const double to = std::round(range.hue_to * hues / degrees_round);
    const bool through_red = to < from;
    mark(from, through_red ? hues - 1 : to, marked);
    if (through_red || to == hues) {  // a full circle ends at red again
        cv::Mat beyond;
        mark(0, through_red ? to : 0, beyond);
        cv::bitwise_or(marked, beyond, marked);
    }
    return largest_blob(mask);
}

ColorDetector::ColorDetector(std::string name, bool wait)
    : ImageComponent(std::move(name), "ColorDetector", wait),
      visible_(add_out_port<bool>("visible", "whether something of the colour was in sight, once for each picture")),
      centre_(add_out_port<std::vector<double>>(
          "centre",
          "{ left, up } of its centre: 1 at the left, and at the upper, edge of the picture, -1 at the other; "
          "silent while nothing is in sight")),
      area_(add_out_port<double>("area", "its share of the picture, 0 to 1, together with centre")) {
    const auto bound = [this](std::string of, double initial, double max, std::string unit, std::string doc) {
        declare({.name = std::move(of),
                 .initial = initial,
                 .min = 0,
                 .max = max,
                 .widget = "slider",
                 .unit = std::move(unit),
                 .doc = std::move(doc)});
    };
    bound("hue_from", 340, degrees_round, "deg", "first hue of the colour: 0 red, 60 yellow, 120 green, 240 blue");
    bound("hue_to", 20, degrees_round, "deg", "last hue; below hue_from: from there through red (360, 0) to here");
    bound("saturation_from", 0.4, 1, "", "lowest saturation: 0 grey");
    bound("saturation_to", 1, 1, "", "highest saturation");
    bound("value_from", 0.2, 1, "", "lowest value: 0 black");
    bound("value_to", 1, 1, "", "highest value");
    bound("least_area", 0.0005, 1, "", "smallest area, as a share of the picture");
    declare_latency();
    use_one_thread();
}

Expected<ColorDetector::DetectionTask> ColorDetector::detection_task(const CameraImage& image) {
    const ColorRange range{.hue_from = value<double>("hue_from"),
                           .hue_to = value<double>("hue_to"),
                           .saturation_from = value<double>("saturation_from"),
                           .saturation_to = value<double>("saturation_to"),
                           .value_from = value<double>("value_from"),
                           .value_to = value<double>("value_to")};
    const auto is_empty = [](std::string_view what, double from, double to) {
        return failure(fmt::format("an empty range, as {0}_from = {1} is above {0}_to = {2}", what, from, to));
    };
    if (range.saturation_from > range.saturation_to)
        return is_empty("saturation", range.saturation_from, range.saturation_to);
    if (range.value_from > range.value_to) return is_empty("value", range.value_from, range.value_to);
    auto colored = to_rgb(image, std::move(picture_.pixels));
    if (!colored) return failure("image: " + colored.error().message);
    picture_ = std::move(*colored);
    return [this, range, least_area = value<double>("least_area")]() -> std::optional<ColorSight> {
        const auto blob = find_color(picture_, range);
        if (!blob) return std::nullopt;
        const double area = blob->area / picture_.width / picture_.height;
        if (area < least_area) return std::nullopt;
        return ColorSight{from_middle(blob->x, picture_.width), from_middle(blob->y, picture_.height), area};
    };
}

void ColorDetector::publish(const std::optional<ColorSight>& sight) {
    visible_.write(sight.has_value());
    if (!sight) return;
    centre_.write({sight->left, sight->up});
    area_.write(sight->area);
}

}  // namespace nezumi
