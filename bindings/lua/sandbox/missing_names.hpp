// Names that scripts do not have, and their replacements.
#pragma once

#include <vector>

#include "bindings/lua/syntax/globals.hpp"

namespace nezumi {

/// Functions of Lua 5.1 to 5.3, functions of 5.4 that the sandbox omits, and words of other languages: "unpack",
/// "math.atan2", "null".
const std::vector<Instead>& missing_names();

}  // namespace nezumi
