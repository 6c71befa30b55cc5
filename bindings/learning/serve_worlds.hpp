// Serves worlds to a learning program by lines of text.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "bindings/learning/episode.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

struct ServedWorlds {
    int memory = -1;         ///< descriptor of the shared memory
    std::size_t worlds = 1;  ///< in the memory
    std::size_t first = 0;   ///< of this process
    std::size_t count = 1;   ///< of this process
    std::string version{};   ///< of the program, for journals
};

/// First writes a line that describes the environment and the arrays (JSON). Then reads commands, one a line, until the
/// input ends, and answers each:
///   reset SEED      begins episodes; without SEED, with the next seeds
///   step            runs one step of all worlds of this process
///   reload          reads the environment's file again
///   save WORLD FILE writes the journal of a world's episode
/// An answer is `{}` or `{"error":"..."}`. The result is an error if the worlds can't be made.
Expected<void> serve_worlds(const EpisodePlan& plan, const ServedWorlds& served, std::istream& in, std::ostream& out);

}  // namespace nezumi
