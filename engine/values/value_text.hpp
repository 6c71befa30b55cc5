// Values as texts: exactly as Lua reads them, or short for a person.
#pragma once

#include <cstddef>
#include <string>

#include "engine/values/view.hpp"

namespace nezumi {

/// A value as Lua writes it: `0.25`, `30`, `true`, `"text"`, `{ 1.0, 0.5 }`. Numbers and texts read back as the same.
std::string lua_text(const ValueView& value);

/// "{ vx = 0.1, vy = 0, va = 0 }", "{ 31, 0, 0, 0 }", "true": one line of at most about `width` characters, with
/// "..." where there is more. Numbers with six digits.
std::string short_text(const ValueView& value, std::size_t width = 80);

}  // namespace nezumi
