// Nothing of a picture is believed before its sizes agree.
#include "engine/vision/checked_image.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

namespace nezumi {
namespace {

struct Format {
    std::string_view name;
    int bits;
    int to_gray;  // OpenCV's conversion
    int to_rgb;   // OpenCV's conversion, or `none`
};
constexpr int none = -1;
constexpr Format formats[] = {{"gray8", 8, none, none},
                              {"mono8", 8, none, none},
                              {"rgb8", 24, cv::COLOR_RGB2GRAY, none},
                              {"bgr8", 24, cv::COLOR_BGR2GRAY, cv::COLOR_BGR2RGB}};

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

// The format of a picture whose sizes agree.
Expected<Format> checked_format(const CameraImage& image) {
    if (image.width == 0 || image.height == 0 || image.pixels.empty()) {
        return failure(
            fmt::format("an empty picture ({} x {}, {} bytes)", image.width, image.height, image.pixels.size()));
    }
    auto format = format_of(image);
    if (!format) return format;
    const std::size_t needed = std::size_t{image.width} * image.height * static_cast<std::size_t>(format->bits) / 8;
    if (image.pixels.size() != needed) {
        return failure(fmt::format("{} x {} pixels of {} need {} bytes, got {}", image.width, image.height,
                                   format->name, needed, image.pixels.size()));
    }
    return format;
}

// The pixels by one of OpenCV's conversions from three channels to so many.
Octets converted(const CameraImage& image, int conversion, int channels, Octets pixels) {
    if (conversion == none) {
        pixels = image.pixels;
        return pixels;
    }
    pixels.resize(std::size_t{image.width} * image.height * static_cast<std::size_t>(channels));
    // OpenCV has no matrix that is not to be written; this one is only read.
    const cv::Mat from(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat to(image.height, image.width, CV_8UC(channels), pixels.data());
    cv::cvtColor(from, to, conversion);
    return pixels;
}

}  // namespace

Expected<GrayImage> to_gray(const CameraImage& image, Octets memory) {
    const auto format = checked_format(image);
    if (!format) return Unexpected(format.error());
    return GrayImage{image.width, image.height, converted(image, format->to_gray, 1, std::move(memory))};
}

Expected<ColorImage> to_rgb(const CameraImage& image, Octets memory) {
    const auto format = checked_format(image);
    if (!format) return Unexpected(format.error());
    if (format->bits != 24) return failure(fmt::format("{} has no colours: expected rgb8 or bgr8", format->name));
    return ColorImage{image.width, image.height, converted(image, format->to_rgb, 3, std::move(memory))};
}

}  // namespace nezumi
