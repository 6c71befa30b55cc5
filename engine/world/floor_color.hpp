// The colours that a colour sensor can tell apart.
#pragma once

#include <cstdint>
#include <string_view>

namespace nezumi {

/// 0xRRGGBB.
using Rgb = std::uint32_t;

/// In the order of the EV3's own codes.
enum class FloorColor { none, black, blue, green, yellow, red, white, brown };

/// "none", "black", ...
std::string_view to_text(FloorColor color);

/// The colour's name as a colour sensor gives it: by hue, or black and white where there is little of it.
FloorColor nearest_floor_color(Rgb color);

/// 0 (black) to 100 (white): the luma of ITU-R BT.601.
double brightness(Rgb color);

}  // namespace nezumi
