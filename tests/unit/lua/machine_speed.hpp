// How slow this machine is now, so that limits of CPU time in tests hold on any.
#pragma once

#include <algorithm>
#include <cstdint>

#include "tests/unit/lua/sandbox_support.hpp"

namespace nezumi {

/// CPU time [s] that a fixed piece of Lua takes now over what it takes on an idle desktop, at least 1: sanitizers, a
/// slow machine and busy neighbours are all in it. Takes about 10 ms there.
inline double slowness() {
    constexpr double on_a_desktop = 0.01;
    Box box;
    const std::int64_t began = thread_time();
    box.run("local t = {} for i = 1, 100000 do t[i % 1000 + 1] = { i, { i } } end return #t");
    return std::max(1.0, static_cast<double>(thread_time() - began) * 1e-9 / on_a_desktop);
}

}  // namespace nezumi
