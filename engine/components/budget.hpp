// What one call into a script may use up.
#pragma once

namespace nezumi {

struct Budget {
    double seconds = 0.1;  ///< of CPU time of the calling thread
};

inline constexpr Budget paced_budget{0.1};     ///< in runs that follow the clock, and on hardware
inline constexpr Budget headless_budget{2.0};  ///< in runs without a clock, where reaching it ends the run

}  // namespace nezumi
