// Sends messages from the program to the worker that runs it.
#pragma once

#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// Where worker.js writes the shipped files.
inline constexpr const char* installed_files = "/share/nezumi";

/// Sends bytes or a text to the worker, by the function `send` of its module.
void send_bytes(std::string_view bytes);
void send_text(std::string_view text);
/// Writes the error to standard error and returns 2.
int refuse(const Error& error);

}  // namespace nezumi
