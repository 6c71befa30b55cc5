// Worlds that are stepped together, each with one episode after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/learning/episode.hpp"
#include "bindings/learning/shared_arrays.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

class WorldBatch {
public:
    /// The worlds `first` to `first + count - 1` of those in the arrays, which must outlive the batch.
    WorldBatch(EpisodePlan plan, const SharedArrays& arrays, std::size_t first, std::size_t count);

    /// Begins an episode in each world: world i gets `seed + i`; without a seed, each world gets the one after its
    /// last.
    Expected<void> reset(std::optional<std::uint64_t> seed);
    /// Gives every world its action and runs a step. A world whose episode is over begins the next one instead, and
    /// ignores its action. The error is the first one; it says which world. That world's episode is over then.
    Expected<void> step();
    /// Episodes from now on use the present text of the file. After an error the text before it stays.
    Expected<void> reload();
    /// Repeats the present episode of a world, or the one that is over, and writes its journal. An error if the
    /// repetition differs, because files were changed meanwhile. `version`: of the program.
    Expected<void> save(std::size_t world, const std::filesystem::path& file, const std::string& version) const;

private:
    struct World {
        std::shared_ptr<const EpisodePlan> plan;
        std::unique_ptr<Episode> episode;
        std::uint64_t seed = 0;
        std::int64_t steps = 0;
        bool over = true;
        std::optional<Error> error;  // the error that ended the episode
        std::vector<float> actions;  // of all steps
    };

    Expected<void> begin(std::size_t index);
    Expected<void> step(std::size_t index);
    Expected<void> each(Expected<void> (WorldBatch::*act)(std::size_t));

    std::shared_ptr<const EpisodePlan> plan_;
    const SharedArrays& arrays_;
    std::size_t first_;
    std::vector<World> worlds_;
};

}  // namespace nezumi
