// What fuzzers ask of whatever comes out.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/visible.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {

inline void require(bool holds) {
    if (!holds) std::abort();
}

inline bool is_finite(const Point3D& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}
inline bool is_positive(double value) { return std::isfinite(value) && value > 0; }

/// One line of text that a terminal can show, no longer than a screen.
inline void require_line(std::string_view text) {
    require(!text.empty() && text.size() < 2000);
    require(text.find('\n') == std::string_view::npos && visible(text) == text);
}

/// An error of a file: one line, and where.
inline void check(const Error& error) {
    require(!error.place.file.empty() && error.place.line >= 0);
    require_line(error.message);
}

}  // namespace nezumi
