// Uses a picture only after its sizes have been checked.
#include "engine/vision/checked_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

namespace nezumi {
namespace {

constexpr int none = -1;

struct Format {
    std::string_view name;
    int bits;
    int type;      // OpenCV's, of a pixel
    int to_gray;   // OpenCV's conversion, or `none`: the picture is grey
    int to_rgb;    // OpenCV's conversion, or `none`: the picture is red, green and blue, or grey
    bool colored;  // has colours
};
// The names of sensor_msgs/image_encodings.hpp, and our own for grey.
constexpr Format formats[] = {{"gray8", 8, CV_8UC1, none, none, false},
                              {"mono8", 8, CV_8UC1, none, none, false},
                              {"rgb8", 24, CV_8UC3, cv::COLOR_RGB2GRAY, none, true},
                              {"bgr8", 24, CV_8UC3, cv::COLOR_BGR2GRAY, cv::COLOR_BGR2RGB, true},
                              {"8UC3", 24, CV_8UC3, cv::COLOR_BGR2GRAY, cv::COLOR_BGR2RGB, true},
                              {"rgba8", 32, CV_8UC4, cv::COLOR_RGBA2GRAY, cv::COLOR_RGBA2RGB, true},
                              {"bgra8", 32, CV_8UC4, cv::COLOR_BGRA2GRAY, cv::COLOR_BGRA2RGB, true},
                              {"mono16", 16, CV_16UC1, none, none, false},
                              {"yuv422_yuy2", 16, CV_8UC2, cv::COLOR_YUV2GRAY_YUY2, cv::COLOR_YUV2RGB_YUY2, true},
                              {"yuv422", 16, CV_8UC2, cv::COLOR_YUV2GRAY_UYVY, cv::COLOR_YUV2RGB_UYVY, true}};
constexpr std::string_view jpeg = "jpeg";
constexpr std::string_view compressed[] = {jpeg, "png"};

Expected<Format> format_of(const CameraImage& image) {
    std::vector<std::string_view> names;
    for (const Format& format : formats) {
        names.push_back(format.name);
        if (image.format.empty() ? image.bpp != format.bits : image.format != format.name) continue;
        if (image.bpp != format.bits) {
            return failure(
                fmt::format("format '{}' has {} bits per pixel, got bpp = {}", format.name, format.bits, image.bpp));
        }
        if (image.format.empty() && image.bpp != 8 && image.bpp != 24) break;
        return format;
    }
    if (image.format.empty())
        return failure(fmt::format("a picture without a format must have a bpp of 8 or 24, got {}", image.bpp));
    names.insert(names.end(), std::begin(compressed), std::end(compressed));
    return failure(fmt::format("unknown format '{}': expected {}{}", shown(image.format), fmt::join(names, ", "),
                               did_you_mean(image.format, names)));
}

// The format of an image; an error if its sizes are inconsistent.
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
    if (format->type == CV_8UC2 && image.width % 2 != 0)
        return failure(fmt::format("{} pixels in a row of {}: expected an even number", image.width, format->name));
    return format;
}

// Whether the pixels can be used as they are: no conversion by OpenCV, and no 16-bit pixels.
bool is_as_needed(const Format& format, int conversion) { return conversion == none && format.type != CV_16UC1; }

// Converts the pixels with OpenCV to this number of channels.
Octets converted(const CameraImage& image, const Format& format, int conversion, int channels, Octets pixels) {
    if (is_as_needed(format, conversion)) {
        pixels = image.pixels;
        return pixels;
    }
    pixels.resize(std::size_t{image.width} * image.height * static_cast<std::size_t>(channels));
    // OpenCV has no read-only matrix; this one is only read.
    const cv::Mat from(image.height, image.width, format.type, const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat to(image.height, image.width, CV_8UC(channels), pixels.data());
    constexpr double to_a_byte = 1 / 257.0;
    if (format.type == CV_16UC1) {
        from.convertTo(to, CV_8U, to_a_byte);
    } else {
        cv::cvtColor(from, to, conversion);
    }
    return pixels;
}

bool is_compressed(const CameraImage& image) {
    return std::find(std::begin(compressed), std::end(compressed), image.format) != std::end(compressed);
}

// Decodes a compressed picture as rgb8.
Expected<CameraImage> decoded(const CameraImage& image) {
    const auto picture = decode_picture({reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size()});
    if (!picture) return failure(fmt::format("a {} that can't be read: {}", image.format, picture.error().message));
    constexpr int most = std::numeric_limits<std::uint16_t>::max();
    if (picture->width > most || picture->height > most)
        return failure(
            fmt::format("{} x {} pixels: expected at most 65535 in each direction", picture->width, picture->height));
    CameraImage rgb{.width = static_cast<std::uint16_t>(picture->width),
                    .height = static_cast<std::uint16_t>(picture->height),
                    .bpp = 24,
                    .format = "rgb8"};
    rgb.pixels.reserve(picture->pixels.size() * 3);
    for (const Rgb pixel : picture->pixels) {
        for (const int shift : {16, 8, 0}) rgb.pixels.push_back(static_cast<std::uint8_t>(pixel >> shift & 0xff));
    }
    return rgb;
}

}  // namespace

Expected<GrayImage> to_gray(const CameraImage& image, Octets memory) {
    if (is_compressed(image)) {
        const auto rgb = decoded(image);
        return rgb ? to_gray(*rgb, std::move(memory)) : Unexpected(rgb.error());
    }
    const auto format = checked_format(image);
    if (!format) return Unexpected(format.error());
    return GrayImage{image.width, image.height, converted(image, *format, format->to_gray, 1, std::move(memory))};
}

Expected<ColorImage> to_rgb(const CameraImage& image, Octets memory) {
    if (is_compressed(image)) {
        const auto rgb = decoded(image);
        return rgb ? to_rgb(*rgb, std::move(memory)) : Unexpected(rgb.error());
    }
    const auto format = checked_format(image);
    if (!format) return Unexpected(format.error());
    if (!format->colored) return failure(fmt::format("{} has no colours: expected rgb8 or bgr8", format->name));
    return ColorImage{image.width, image.height, converted(image, *format, format->to_rgb, 3, std::move(memory))};
}

Expected<JpegPicture> to_jpeg(const CameraImage& image) {
    if (is_compressed(image)) {
        const auto rgb = decoded(image);
        if (!rgb) return Unexpected(rgb.error());
        if (image.format == jpeg) return JpegPicture{rgb->width, rgb->height, image.pixels};
        return to_jpeg(*rgb);
    }
    const auto format = checked_format(image);
    if (!format) return Unexpected(format.error());
    const int channels = format->colored ? 3 : 1;
    const int conversion = format->colored ? format->to_rgb : format->to_gray;
    if (is_as_needed(*format, conversion)) return encode_jpeg(image.width, image.height, channels, image.pixels);
    return encode_jpeg(image.width, image.height, channels, converted(image, *format, conversion, channels, {}));
}

}  // namespace nezumi
