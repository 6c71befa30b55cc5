// Runs a system at 100 Hz by the clock, as real devices need it.
#pragma once

#include <functional>

#include "engine/system/pacer.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// Runs for this time, or until `until` returns true; returns whether it did, or true without it. `before` is called
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
