// Converts tones to WAV files.
#pragma once

#include <string>

namespace nezumi {

/// A tone as the content of a WAV file: 22 050 samples per second, 16 bits, mono. It fades in and out in 5 ms to avoid
/// clicks. 0 Hz is silence.
std::string tone_as_wav(double hertz, double seconds);

}  // namespace nezumi
