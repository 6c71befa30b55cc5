// Finds the first comment of a file, which documents it.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// The comment lines at the start of a Lua file, without their dashes, at most 2000 bytes; "" if there are none. A long
/// bracket (`--[[ ... ]]`) does not count.
std::string first_comment(std::string_view source);

}  // namespace nezumi
