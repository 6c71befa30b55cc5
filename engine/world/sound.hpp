// The sound for a text on a speaker's in-port: a tone, or speech.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

struct Sound {
    enum class Kind { nothing, tone, speech };
    Kind kind = Kind::nothing;
    double hertz = 0;    ///< tone: 0 is a pause
    double seconds = 0;  ///< tone
    std::string text;    ///< speech: any text
};

inline constexpr int highest_tone = 20'000;  ///< [Hz] limit of tones
inline constexpr int longest_tone = 60'000;  ///< [ms] limit of tones

/// "beep" is a tone of 440 Hz and 0.2 s; "tone,HZ,MS" with two whole numbers is a tone; any other text is spoken, also
/// "tone,high,100". Blanks around the text and around its numbers are ignored; a text of blanks gives no sound.
Sound read_sound(std::string_view text);

}  // namespace nezumi
