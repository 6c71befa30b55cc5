// Translates the input of the console to Lua, which it extends a little.
#pragma once

#include <string>
#include <string_view>

#include "bindings/lua/sandbox/compile.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Translates `controller.in` to Lua: a keyword after a dot becomes `controller["in"]`. In Lua no keyword may follow a
/// dot, so no other text changes; strings and comments stay as they are. Line numbers stay the same.
std::string with_keyword_names(std::string_view text);

/// Whether the arguments of a command may be parts of values: `plot(controller.out.vx)`.
bool takes_values(std::string_view command);

/// Translates `plot(controller.out.vx, 5)` to Lua: an argument of `plot` that consists of names and indices becomes `{
/// controller, ".out.vx" }` unless it is a port, because a plain value does not tell its source. No other text changes.
std::string with_plotted_names(std::string_view text);

/// Compiles an input; an expression returns its values. If both fail, the error is the one of the input as statements.
/// The location of the error is the line within the input.
Expected<Chunk> compile_input(std::string_view text);

/// Whether an input is complete: no block, string, comment or bracket is open at its end.
bool is_complete_input(std::string_view text);

/// The file name of locations within an input.
inline constexpr const char* input_name = "console";

}  // namespace nezumi
