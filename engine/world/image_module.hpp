// The interface between the program and its module for pictures. Both are built together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/values/type.hpp"
#include "engine/world/picture.hpp"

namespace nezumi {

inline constexpr const char* image_module = "nezumi_images.so";
inline constexpr const char* decode_in_module = "nezumi_decode_image";
inline constexpr const char* encode_in_module = "nezumi_encode_jpeg";

/// Decodes the content of a picture file, in any format of OpenCV. Transparent parts
/// become white; a photograph is turned upright. Returns false with the `problem`. Never throws.
using DecodeInModule = bool(const std::uint8_t* bytes, std::size_t size, Picture& picture, std::string& problem);

/// Writes width * height pixels, grey or red, green and blue, as JPEG. Returns false with the `problem`. Never throws.
using EncodeInModule = bool(int width, int height, int channels, const std::uint8_t* pixels, Octets& jpeg,
                            std::string& problem);

}  // namespace nezumi
