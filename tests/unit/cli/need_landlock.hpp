// Skips a test where the kernel can't confine a pupil's program.
#pragma once

#include <stdexcept>

#include "bindings/web/classroom/confinement.hpp"

namespace nezumi {

inline void need_landlock() {
    if (!web::can_confine())
        throw std::runtime_error("SKIPPED: this kernel has no Landlock, or a sanitizer needs /proc");
}

}  // namespace nezumi
