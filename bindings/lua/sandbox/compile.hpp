// From Lua source text to a chunk that many states can load.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

inline constexpr std::size_t source_size_limit = std::size_t{1} << 20;  ///< [bytes] of one file
inline constexpr double compile_seconds_limit = 2.0;                    ///< of CPU time

/// Compiled Lua. Immutable; states in any thread may load it. Loading runs nothing.
struct Chunk {
    std::string file;      ///< as error messages name it
    std::string bytecode;  ///< of this program's own making, with the lines for error messages
};

/// Compiles a source text. A byte order mark and a first line that begins with '#' are skipped. Bytecode is refused.
Expected<Chunk> compile(std::string_view source, const std::string& file);

/// Compiles, and refuses every use of a global that is not known: either a chunk, or all that is wrong, in order of
/// place.
tl::expected<Chunk, std::vector<Error>> compile_checked(std::string_view source, const std::string& file,
                                                        const KnownGlobals& known);

/// Pushes the chunk's main function. Its globals are the state's.
CallResult load_chunk(lua_State* lua, const Chunk& chunk);

}  // namespace nezumi
