// Checks the picture of a camera and converts it to grey, or to red, green and blue.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"
#include "engine/world/picture.hpp"

namespace nezumi {

struct GrayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;  ///< row by row from the top left
};

struct ColorImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;  ///< row by row from the top left; red, green and blue of each
};

/// The grey values (ITU-R BT.601) of a picture in the format "gray8", or in one of ROS: "mono8", "mono16", "rgb8",
/// "bgr8", "8UC3" (as "bgr8"), "rgba8", "bgra8", "yuv422_yuy2", "yuv422", or compressed as "jpeg" or "png", which
/// OpenCV decodes; without a format 8 bits per pixel are grey and 24 red, green, blue. An error says what does not fit:
/// no pixels, an unknown format, bits that are not the format's, or a number of bytes that is not width * height * bpp
/// / 8. The result's pixels reuse the buffer `memory`, such as that of an earlier picture.
Expected<GrayImage> to_gray(const CameraImage& image, Octets memory = {});

/// The colours of a picture. Errors as in `to_gray`; a grey picture is an error too.
Expected<ColorImage> to_rgb(const CameraImage& image, Octets memory = {});

/// The picture as JPEG, grey or in colours. A JPEG picture is returned unchanged. Errors as in `to_gray`.
Expected<JpegPicture> to_jpeg(const CameraImage& image);

}  // namespace nezumi
