// The colours that a colour sensor can tell apart.
#pragma once

#include <string_view>

namespace nezumi {

/// In the order of the EV3's own codes.
enum class FloorColor { none, black, blue, green, yellow, red, white, brown };

/// "none", "black", ...
std::string_view to_text(FloorColor color);

}  // namespace nezumi
