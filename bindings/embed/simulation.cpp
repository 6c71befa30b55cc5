// A system that the calling program ticks.
#include "bindings/embed/simulation.hpp"

#include <cmath>
#include <utility>

namespace nezumi {

Expected<Simulation> Simulation::load(const std::filesystem::path& file, Options options) {
    LiveOptions live = simulated_systems(std::move(options.installed));
    live.budget = headless_budget;
    live.build.log = std::move(options.log);
    return load_with(file, std::move(live));
}

Expected<Simulation> Simulation::load_with(const std::filesystem::path& file, LiveOptions options) {
    auto loaded = RunningSystem::load(file, std::move(options));
    if (!loaded) return Unexpected(loaded.error());
    (*loaded)->activate();
    return Simulation(std::move(*loaded));
}

void Simulation::run(double seconds) {
    for (auto left = std::llround(seconds * system().settings().rate); left > 0; --left) tick();
}

}  // namespace nezumi
