// QR codes of addresses for a terminal: a module with libqrencode, loaded on demand.
#pragma once

#include <string>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// Returns the QR code as lines for a terminal of any colours: each line has two rows of modules (squares), dark on
/// light, with a quiet zone around the code. An error gives the reason, for example that the text is too long.
Expected<std::string> qr_code(const std::string& text);

// The interface between the program and its module. Both are built together.
inline constexpr const char* qr_module = "nezumi_qr.so";
inline constexpr const char* draw_in_module = "nezumi_draw_qr";
/// The only function that the module exports. Returns true, or sets `problem` and returns false. Never throws.
using DrawInModule = bool(const std::string& text, std::string& lines, std::string& problem);

}  // namespace nezumi::web
