// Pictures as JPEG: a module with OpenCV's writer, loaded when a browser first watches a picture.
#pragma once

#include <string>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::web {

/// The picture as JPEG. Its pixels must be of the number that its size says. From any one thread.
Expected<Octets> to_jpeg(const CameraImage& picture);

// What the program and its module know of each other: they are built together.
inline constexpr const char* jpeg_module = "nezumi_jpeg.so";
inline constexpr const char* encode_in_module = "nezumi_encode_jpeg";
/// The module's one function: whether it went well, or else the `problem`. It throws nothing.
using EncodeInModule = bool(const CameraImage& picture, Octets& jpeg, std::string& problem);

}  // namespace nezumi::web
