// One episode of an environment: a system from its start, and the functions of the environment's file. Its results
// depend only on the files, the seed and the actions.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bindings/learning/environment_file.hpp"
#include "bindings/lua/live/objects.hpp"
#include "bindings/lua/sandbox/call.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"
#include "engine/project/project.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// The data that all episodes share.
struct EpisodePlan {
    SourceText source;                            ///< of the environment's file
    Project project;                              ///< of the environment
    std::function<LiveOptions()> systems;         ///< makes the options for each system
    std::function<void(std::string_view)> print;  ///< gets what scripts print, a line at a time
};

struct StepResult {
    double reward = 0;
    bool terminated = false;
};

class Episode {
public:
    /// Starts the system with this seed and runs its first tick. `loaded` gets the system before it is active; may be
    /// empty. `plan` must outlive the episode.
    static Expected<std::unique_ptr<Episode>> begin(const EpisodePlan& plan, std::uint64_t seed,
                                                    const std::function<void(RunningSystem&)>& loaded = {});
    Episode(const Episode&) = delete;
    Episode& operator=(const Episode&) = delete;
    ~Episode();

    const EnvironmentSpec& spec() const { return file_->spec(); }
    RunningSystem& live() { return *live_; }

    /// Writes the present observation, whose length is that of all its parts. After an error, here or in `step`, the
    /// episode can't continue.
    Expected<void> observe(std::span<float> observation);
    /// Passes the action to the environment, runs the ticks of a step, and observes.
    Expected<StepResult> step(std::span<const float> action, std::span<float> observation);

private:
    Episode() = default;
    Expected<void> load(const EpisodePlan& plan, std::uint64_t seed);
    Expected<StartValues> start_values();
    Expected<void> tick();
    /// Calls a function with the arguments that it takes: the world and the action. Leaves one result on the stack.
    Expected<void> call(EnvironmentFunction function, std::span<const float> action = {});
    Expected<double> number(EnvironmentFunction function, std::span<const float> action);

    std::unique_ptr<RunningSystem> live_;  // outlives the Lua state
    std::unique_ptr<EnvironmentFile> file_;
    std::unique_ptr<Objects> objects_;
};

}  // namespace nezumi
