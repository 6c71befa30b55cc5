// Files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// Writes `text` under a name of its own beside `file` ("FILE.new") and gives it its name when all of it is there:
/// whatever goes wrong, what was there before is still there, and nothing else. A link is followed; a device or a pipe
/// is written as it is. The error says why not, with the file as its place.
Expected<void> write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace nezumi
