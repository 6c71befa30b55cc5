// The source text of executed lines.
#pragma once

#include "bindings/lua/script/script.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

/// Adds its text to each line, if the script still has the text, and removes the values of variables that the text does
/// not name.
void add_texts(TracedLines& traced, const Script& script);

}  // namespace nezumi
