// Names of Lua that scripts don't have, and what there is instead.
#pragma once

#include <vector>

#include "bindings/lua/syntax/globals.hpp"

namespace nezumi {

/// Functions of Lua 5.1 to 5.3, those of 5.4 that the sandbox leaves out, and words of other languages: "unpack",
/// "math.atan2", "null".
const std::vector<Instead>& missing_names();

}  // namespace nezumi
