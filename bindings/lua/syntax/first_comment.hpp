// What a file says of itself, in the comment that it begins with.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// The lines of comment at the start of a Lua file, without their dashes, at most 2000 bytes; "" when it begins with
/// none. A long bracket (`--[[ ... ]]`) is none.
std::string first_comment(std::string_view source);

}  // namespace nezumi
