// Writes a system as a system file.
#pragma once

#include <string>

#include "engine/system/system_spec.hpp"

namespace nezumi {

/// The text of a system file for `spec`: reading it gives the same arena, entries and connections, in the same order.
/// `title` becomes its first line, a comment.
std::string write_system_text(const SystemSpec& spec, const std::string& title);

}  // namespace nezumi
