// Divides the area in front of the robot into line and floor; the largest connected region is the line.
#include "engine/vision/line_detector.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "engine/vision/one_thread.hpp"

namespace nezumi {
namespace {

constexpr double line_smoothing = 1.5;  // [px] noise makes a line's edge rough, and spots elsewhere
constexpr double white = 255;

}  // namespace

std::optional<Blob> find_line(const GrayImage& image, const LineSettings& settings) {
    const int first = std::min(static_cast<int>(std::lround(settings.top * image.height)), image.height - 1);
    GrayImage mask{image.width, image.height - first, {}};
    mask.pixels.resize(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
    // cv::Mat has no constructor for const data; this one is only read.
    const cv::Mat whole(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat part, marked(mask.height, mask.width, CV_8UC1, mask.pixels.data());
    cv::GaussianBlur(whole.rowRange(first, image.height), part, {}, line_smoothing);
    const int side = settings.dark ? cv::THRESH_BINARY_INV : cv::THRESH_BINARY;
    cv::threshold(part, marked, 0, white, side | cv::THRESH_OTSU);
    // Otsu's method finds a threshold even in pure noise: so line and floor must also differ enough.
    const int count = cv::countNonZero(marked);
    if (count == 0 || count == mask.width * mask.height) return std::nullopt;
    const cv::Mat rest = ~marked;
    const double difference = cv::mean(part, marked)[0] - cv::mean(part, rest)[0];
    if (std::abs(difference) < settings.contrast * white) return std::nullopt;
    auto line = largest_blob(mask);
    if (line) line->y += first;
    return line;
}

LineDetector::LineDetector(std::string name, bool wait)
    : ImageComponent(std::move(name), "LineDetector", wait),
      visible_(add_out_port<bool>("visible", "whether a line was in sight, once for each picture")),
      offset_(
          add_out_port<double>("offset",
                               "where its centre is: 1 at the left edge of the picture, -1 at the right one; silent "
                               "while no line is in sight")),
      angle_(add_out_port<double>("angle",
                                  "[rad] its angle in the picture: 0 straight ahead, positive to the left; "
                                  "together with offset")) {
    declare(
        {.name = "dark", .initial = true, .doc = "a dark line on a light floor; false: a light one on a dark floor"});
    declare({.name = "contrast",
             .initial = 0.3,
             .min = 0,
             .max = 1,
             .widget = "slider",
             .doc = "least difference of line and floor: 1 is black against white"});
    declare({.name = "top",
             .initial = 0.5,
             .min = 0,
             .max = 0.95,
             .widget = "slider",
             .doc = "upper share of the picture that is ignored"});
    declare({.name = "least_area",
             .initial = 0.005,
             .min = 0,
             .max = 1,
             .doc = "smallest area of a line, as a share of the picture"});
    declare_latency();
    use_one_thread();
}

Expected<LineDetector::DetectionTask> LineDetector::detection_task(const CameraImage& image) {
    auto gray = to_gray(image, std::move(picture_.pixels));
    if (!gray) return failure("image: " + gray.error().message);
    picture_ = std::move(*gray);
    const LineSettings settings{
        .dark = value<bool>("dark"), .contrast = value<double>("contrast"), .top = value<double>("top")};
    return [this, settings, least_area = value<double>("least_area")]() -> std::optional<LineSight> {
        const auto line = find_line(picture_, settings);
        if (!line || line->area < least_area * picture_.width * picture_.height) return std::nullopt;
        return LineSight{from_middle(line->x, picture_.width), line->angle};
    };
}

void LineDetector::publish(const std::optional<LineSight>& sight) {
    visible_.write(sight.has_value());
    if (!sight) return;
    offset_.write(sight->offset);
    angle_.write(sight->angle);
}

}  // namespace nezumi
