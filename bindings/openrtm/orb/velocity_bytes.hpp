// The encoded form of a velocity message: a stamp, then the velocity. The velocity is zero if all its bytes are zero.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/ports/port_base.hpp"

namespace nezumi::openrtm {

using Bytes = std::vector<std::uint8_t>;

/// The message type of velocities.
inline constexpr std::string_view velocity_type = "TimedVelocity2D";
/// A robot stops after this time without a velocity.
inline constexpr std::chrono::milliseconds velocity_silence{static_cast<int>(silence * 1000)};

/// Every message begins with RTC::Time, two numbers of 4 bytes.
inline constexpr std::size_t stamp_bytes = 8;

inline bool is_zero(std::span<const std::uint8_t> bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}
/// True if the sender has stamped the message.
inline bool is_stamped(std::span<const std::uint8_t> message) {
    return !is_zero(message.first(std::min(stamp_bytes, message.size())));
}
/// True if a velocity is not zero.
inline bool is_motion(std::span<const std::uint8_t> message) {
    return message.size() > stamp_bytes && !is_zero(message.subspan(stamp_bytes));
}
/// The message with velocity zero.
inline Bytes stopped(Bytes message) {
    if (message.size() > stamp_bytes) std::fill(message.begin() + stamp_bytes, message.end(), std::uint8_t{0});
    return message;
}

}  // namespace nezumi::openrtm
