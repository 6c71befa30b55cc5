// The colours that a colour sensor can distinguish.
#pragma once

#include <cstdint>
#include <string_view>

namespace nezumi {

/// 0xRRGGBB.
using Rgb = std::uint32_t;

/// The values are the colour codes of the EV3's colour sensor, 0 to 7.
enum class FloorColor { none, black, blue, green, yellow, red, white, brown };

/// "none", "black", ...
std::string_view to_text(FloorColor color);

/// The nearest of these colours: by hue, or black or white for little saturation.
FloorColor nearest_floor_color(Rgb color);

/// 0 (black) to 100 (white): the luma of ITU-R BT.601.
double brightness(Rgb color);

}  // namespace nezumi
