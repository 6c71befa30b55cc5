// Compiles Lua source text to a chunk that many states can load.
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

/// Compiled Lua. Immutable; states in any thread may load it. Loading executes nothing.
struct Chunk {
    std::string file;      ///< the name in error messages
    std::string bytecode;  ///< made by this program only, with line numbers
};

/// Compiles a source text. Skips a byte order mark, and a first line that begins with '#'. Refuses bytecode.
Expected<Chunk> compile(std::string_view source, const std::string& file);

/// Compiles and refuses unknown globals: returns a chunk, or all mistakes in order of place.
tl::expected<Chunk, std::vector<Error>> compile_checked(std::string_view source, const std::string& file,
                                                        const KnownGlobals& known);

/// Pushes the main function of the chunk. The function uses the globals of the state.
CallResult load_chunk(lua_State* lua, const Chunk& chunk);

}  // namespace nezumi
