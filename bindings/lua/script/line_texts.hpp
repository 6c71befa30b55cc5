// The source text of executed lines.
#pragma once

#include "bindings/lua/script/script.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

/// Adds the text of each line if the script knows it, and removes values that this text does not name.
void add_texts(TracedLines& traced, const Script& script);

}  // namespace nezumi
