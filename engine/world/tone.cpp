// Makes a sine and the header of a WAV file.
#include "engine/world/tone.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace nezumi {
namespace {

constexpr int samples_a_second = 22'050;
constexpr double loudness = 0.3;  // relative to the range of 16 bits
constexpr double swell = 0.005;   // [s] fade in and out

// Appends the lowest bytes of a number, lowest first.
void append(std::string& bytes, std::uint32_t number, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffu);
}

}  // namespace

std::string tone_as_wav(double hertz, double seconds) {
    const auto count = static_cast<std::uint32_t>(std::lround(std::max(0.0, seconds) * samples_a_second));
    std::string bytes = "RIFF";
    append(bytes, 36 + 2 * count, 4);
    bytes += "WAVEfmt ";
    append(bytes, 16, 4);
    append(bytes, 1, 2);  // PCM
    append(bytes, 1, 2);  // mono
    append(bytes, samples_a_second, 4);
    append(bytes, 2 * samples_a_second, 4);  // bytes per second
    append(bytes, 2, 2);                     // bytes per sample
    append(bytes, 16, 2);                    // bits per sample
    bytes += "data";
    append(bytes, 2 * count, 4);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double at = static_cast<double>(i) / samples_a_second;
        const double left = static_cast<double>(count - i) / samples_a_second;
        const double level = loudness * std::min({1.0, at / swell, left / swell});
        const double sample = hertz > 0 ? level * std::sin(2 * std::numbers::pi * hertz * at) : 0;
        append(bytes, static_cast<std::uint32_t>(std::lround(sample * 32767)), 2);
    }
    return bytes;
}

}  // namespace nezumi
