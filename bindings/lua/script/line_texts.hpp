// The texts of lines that ran.
#pragma once

#include "bindings/lua/script/script.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

/// Adds the text of each line, as far as the script knows it, and leaves of its values those that the text names.
void add_texts(TracedLines& traced, const Script& script);

}  // namespace nezumi
