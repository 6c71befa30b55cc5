// What the program and its module for pictures know of each other: they are built together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/world/picture.hpp"

namespace nezumi {

inline constexpr const char* image_module = "nezumi_images.so";
inline constexpr const char* decode_in_module = "nezumi_decode_image";

/// The module's one function: the picture in a file's bytes, of any format that OpenCV reads; transparent parts are
/// white, and a photograph stands as its camera was held. False with the `problem`. It throws nothing.
using DecodeInModule = bool(const std::uint8_t* bytes, std::size_t size, Picture& picture, std::string& problem);

}  // namespace nezumi
