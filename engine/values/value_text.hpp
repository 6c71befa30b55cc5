// Values as texts: exact, so that Lua can read them, or short for a person.
#pragma once

#include <cstddef>
#include <string>

#include "engine/values/view.hpp"

namespace nezumi {

/// A value in Lua syntax: `0.25`, `30`, `true`, `"text"`, `{ 1.0, 0.5 }`. Numbers and texts are read back exactly.
std::string lua_text(const ValueView& value);

/// A value in one line of about `width` characters, with "..." if it is longer: "{ vx = 0.1, vy = 0, va = 0 }", "{ 31,
/// 0, 0, 0 }", "true". Numbers have six digits.
std::string short_text(const ValueView& value, std::size_t width = 80);

}  // namespace nezumi
