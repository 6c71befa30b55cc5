// What the nodes of the mouse's driver (rtmouse) say and take, as text and as values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nezumi::hw {

/// Right front, right side, left side, left front: lit minus ambient light, 12 bits, so a little below 0 at times.
using LightValues = std::array<int, 4>;

/// "1 2 3 4\n", as `/dev/rtlightsensor0` gives it; nothing when it is anything else.
std::optional<LightValues> decode_lights(std::string_view text);
/// "0\n" of `/dev/rtswitchN` is pressed, "1\n" is open.
std::optional<bool> decode_switch(std::string_view text);
/// "65535\n" of `/dev/rtcounter_l0` and `_r0`: 0 to 65535. Signed numbers, which the node gives when another program
/// has opened the signed one, wrap into the same range.
std::optional<std::uint16_t> decode_counter(std::string_view text);

/// A whole number as the raw motor nodes and the buzzer want it: digits and a sign, nothing else.
std::string encode_number(int value);
/// "0" or "1", for `/dev/rtmotoren0` and `/dev/rtled0` to `3`.
std::string encode_switch(bool on);

}  // namespace nezumi::hw
