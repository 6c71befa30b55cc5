// Checks the names of output files before a command starts.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// True if a name ends in .png or .svg.
bool is_picture_name(std::string_view name);
/// Fails if the file could not be written, as far as that can be known beforehand.
Expected<void> check_can_write(const std::string& file);

}  // namespace nezumi::cli
