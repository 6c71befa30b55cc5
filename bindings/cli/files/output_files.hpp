// Names of files that a command is to write, looked at before it begins.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Whether a name ends in .png or .svg.
bool is_picture_name(std::string_view name);
/// An error when a file could not be written there, as far as can be known without writing it.
Expected<void> check_can_write(const std::string& file);

}  // namespace nezumi::cli
