// Addresses as QR codes for a terminal: a module with libqrencode, loaded when one is wanted.
#pragma once

#include <string>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// Lines for a terminal of any colours, two rows of modules in each, dark on light with a quiet zone around. The error
/// says why there is none, as for a text that is too long.
Expected<std::string> qr_code(const std::string& text);

// What the program and its module know of each other: they are built together.
inline constexpr const char* qr_module = "nezumi_qr.so";
inline constexpr const char* draw_in_module = "nezumi_draw_qr";
/// The module's one function: whether it went well, or else the `problem`. It throws nothing.
using DrawInModule = bool(const std::string& text, std::string& lines, std::string& problem);

}  // namespace nezumi::web
