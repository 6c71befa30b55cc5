// Runs a system at 100 Hz by the clock, as real devices need it.
#pragma once

#include <functional>

#include "engine/system/pacer.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// For so many seconds, or until something is so: returns whether it came to that; without it, true. `before` is done
/// before each tick.
inline bool run_paced(System& system, double seconds, const std::function<bool()>& until = nullptr,
                      const std::function<void()>& before = nullptr) {
    Pacer pacer(100, 1);
    const double end = system.now().seconds + seconds;
    while (system.now().seconds < end) {
        pacer.wait();
        if (before) before();
        system.tick();
        if (until && until()) return true;
    }
    return !until;
}

}  // namespace nezumi
