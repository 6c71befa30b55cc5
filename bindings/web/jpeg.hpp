// JPEG pictures: a module with OpenCV's encoder, loaded when a browser first watches a picture.
#pragma once

#include <string>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::web {

/// Returns the picture as JPEG. The number of pixels must agree with its size. Only one thread may call it.
Expected<Octets> to_jpeg(const CameraImage& picture);

// The interface between the program and its module. Both are built together.
inline constexpr const char* jpeg_module = "nezumi_jpeg.so";
inline constexpr const char* encode_in_module = "nezumi_encode_jpeg";
/// The module's only function. Returns true, or false with the `problem`. Never throws.
using EncodeInModule = bool(const CameraImage& picture, Octets& jpeg, std::string& problem);

}  // namespace nezumi::web
