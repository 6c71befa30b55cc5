// Text formats of the mouse's driver (rtmouse) nodes, to and from values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nezumi::hw {

/// Right front, right side, left side, left front. A value is the light with the LED on minus that with the LED off, 12
/// bits each; so it may be slightly negative.
using LightValues = std::array<int, 4>;

/// Reads "1 2 3 4
/// " from `/dev/rtlightsensor0`; nothing for any other text.
std::optional<LightValues> decode_lights(std::string_view text);
/// Reads `/dev/rtswitchN`: "0
/// " is pressed, "1
/// " is open.
std::optional<bool> decode_switch(std::string_view text);
/// Reads `/dev/rtcounter_l0` or `_r0`: 0 to 65535. Negative numbers are converted to this range modulo 65536: the
/// driver gives signed numbers after another program has opened the signed node.
std::optional<std::uint16_t> decode_counter(std::string_view text);

/// An integer for the raw motor nodes and the buzzer: digits and a sign only.
std::string encode_number(int value);
/// "0" or "1", for `/dev/rtmotoren0` and `/dev/rtled0` to `3`.
std::string encode_switch(bool on);

}  // namespace nezumi::hw
