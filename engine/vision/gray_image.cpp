// Nothing of a picture is believed before its sizes agree.
#include "engine/vision/gray_image.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <string_view>

namespace nezumi {
namespace {

struct Format {
    std::string_view name;
    int bits;
    int to_gray;  // OpenCV's conversion
};
constexpr Format formats[] = {
    {"gray8", 8, 0}, {"mono8", 8, 0}, {"rgb8", 24, cv::COLOR_RGB2GRAY}, {"bgr8", 24, cv::COLOR_BGR2GRAY}};

Expected<Format> format_of(const CameraImage& image) {
    std::vector<std::string_view> names;
    for (const Format& format : formats) {
        names.push_back(format.name);
        if (image.format.empty() ? image.bpp != format.bits : image.format != format.name) continue;
        if (image.bpp != format.bits) {
            return failure(
                fmt::format("format '{}' has {} bits a pixel, got bpp = {}", format.name, format.bits, image.bpp));
        }
        return format;
    }
    if (image.format.empty()) return failure(fmt::format("no format, and a bpp of {}: expected 8 or 24", image.bpp));
    return failure(fmt::format("unknown format '{}': expected gray8, mono8, rgb8 or bgr8{}", shown(image.format),
                               did_you_mean(image.format, names)));
}

}  // namespace

Expected<GrayImage> to_gray(const CameraImage& image) {
    if (image.width == 0 || image.height == 0 || image.pixels.empty()) {
        return failure(
            fmt::format("an empty picture ({} x {}, {} bytes)", image.width, image.height, image.pixels.size()));
    }
    const auto format = format_of(image);
    if (!format) return Unexpected(format.error());
    const std::size_t count = std::size_t{image.width} * image.height;
    const std::size_t step = static_cast<std::size_t>(format->bits) / 8;
    if (image.pixels.size() != count * step) {
        return failure(fmt::format("{} x {} pixels of {} need {} bytes, got {}", image.width, image.height,
                                   format->name, count * step, image.pixels.size()));
    }
    GrayImage gray{image.width, image.height, {}};
    if (step == 1) {
        gray.pixels = image.pixels;
        return gray;
    }
    gray.pixels.resize(count);
    // OpenCV has no matrix that is not to be written; this one is only read.
    const cv::Mat from(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat to(image.height, image.width, CV_8UC1, gray.pixels.data());
    cv::cvtColor(from, to, format->to_gray);
    return gray;
}

}  // namespace nezumi
