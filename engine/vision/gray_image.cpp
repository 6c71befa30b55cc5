// Nothing of a picture is believed before its sizes agree.
#include "engine/vision/gray_image.hpp"

#include <fmt/format.h>

#include <string_view>

namespace nezumi {
namespace {

struct Format {
    std::string_view name;
    int bits;
    int red, green, blue;  // which byte of a pixel
};
constexpr Format formats[] = {
    {"gray8", 8, 0, 0, 0}, {"mono8", 8, 0, 0, 0}, {"rgb8", 24, 0, 1, 2}, {"bgr8", 24, 2, 1, 0}};

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
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* pixel = &image.pixels[i * step];
        // 77 + 150 + 29 = 256: BT.601's 0.299, 0.587 and 0.114.
        gray.pixels[i] = static_cast<std::uint8_t>(
            (77 * pixel[format->red] + 150 * pixel[format->green] + 29 * pixel[format->blue] + 128) >> 8);
    }
    return gray;
}

}  // namespace nezumi
