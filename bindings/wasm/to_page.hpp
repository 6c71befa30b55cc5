// How the program answers the worker that drives it.
#pragma once

#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// Where worker.js writes the shipped files.
inline constexpr const char* installed_files = "/share/nezumi";

/// Sends bytes or a text to the worker, by the function `send` of its module.
void send_bytes(std::string_view bytes);
void send_text(std::string_view text);
/// Says on standard error why something can't be done. Returns 2.
int refuse(const Error& error);

}  // namespace nezumi
