// Tones as sound that programs can play.
#pragma once

#include <string>

namespace nezumi {

/// A tone as a WAV file's bytes: 22 050 samples a second, 16 bits, mono. It swells and fades in 5 ms, so that it does
/// not click. 0 Hz is silence.
std::string tone_as_wav(double hertz, double seconds);

}  // namespace nezumi
