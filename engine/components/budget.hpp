// Time limits for calls into scripts.
#pragma once

namespace nezumi {

struct Budget {
    double seconds = 0.1;  ///< of CPU time of the calling thread
};

inline constexpr Budget paced_budget{0.1};     ///< in runs that follow real time, and on hardware
inline constexpr Budget headless_budget{2.0};  ///< in runs that do not follow real time; reaching it ends the run

}  // namespace nezumi
