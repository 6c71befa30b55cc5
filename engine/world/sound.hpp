// What a text on a speaker's in-port asks for: a tone, or to be spoken.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

struct Sound {
    enum class Kind { nothing, tone, speech };
    Kind kind = Kind::nothing;
    double hertz = 0;    ///< tone: 0 is a pause
    double seconds = 0;  ///< tone
    std::string text;    ///< speech: anything, whatever signs are in it
};

inline constexpr int highest_tone = 20'000;  ///< [Hz] higher ones are this
inline constexpr int longest_tone = 60'000;  ///< [ms] longer ones last so long

/// "beep" is a tone of 440 Hz and 0.2 s; "tone,HZ,MS", two whole numbers, is a tone; any other text is spoken, also
/// "tone,high,100". Blanks around the text and around its numbers count for nothing; a text of nothing else is nothing.
Sound read_sound(std::string_view text);

}  // namespace nezumi
