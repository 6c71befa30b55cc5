// What is typed at the prompt, as text: Lua, and a little more.
#pragma once

#include <string>
#include <string_view>

#include "bindings/lua/sandbox/compile.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Makes `controller.in` Lua: a name of Lua's own after a dot becomes `controller["in"]`. In Lua's grammar no keyword
/// follows a dot, so that nothing else changes; strings and comments stay. Lines keep their numbers.
std::string with_keyword_names(std::string_view text);

/// Makes `plot(controller.out.vx, 5)` Lua: where an argument of `plot` is names with a dot or an index between them, it
/// becomes `{ controller, ".out.vx" }` unless it is a port, since the value that it has says not where it is from.
/// Nothing else changes.
std::string with_plotted_names(std::string_view text);

/// An input as a chunk: an expression returns its values. The error is that of the input as statements; its place has
/// the line within the input.
Expected<Chunk> compile_input(std::string_view text);

/// Whether nothing is missing at the end of an input: no block, string, comment or bracket is open.
bool is_complete_input(std::string_view text);

/// The file's name in places within an input.
inline constexpr const char* input_name = "console";

}  // namespace nezumi
