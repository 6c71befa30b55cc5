// `nezumi environment`: tries the environment of a learning program, or serves worlds to such a program.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/learning/episode.hpp"
#include "bindings/learning/serve_worlds.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

struct EnvironmentOptions {
    std::string file;
    std::uint64_t seed = usual_seed;
    std::uint64_t worlds = 1, first = 0;
    std::optional<std::uint64_t> count, memory;
};

constexpr std::uint64_t most_worlds = 100'000;

Expected<EpisodePlan> plan_of(const std::string& path) {
    const Project project = Project::of(path, installed_folders());
    std::string name = project.shown(path);
    auto text = read_whole(path, name);
    if (!text) return Unexpected(text.error());
    return EpisodePlan{.source = {path, std::move(name), std::move(*text)},
                       .project = project,
                       .systems = simulated_systems,
                       .print = [](std::string_view line) { fmt::print(stderr, "{}\n", visible(line)); }};
}

std::string text_of(const std::vector<SpacePart>& parts) {
    std::string all;
    for (const SpacePart& part : parts) {
        all += (all.empty() ? "" : ", ") + part.name;
        if (part.count > 1) all += fmt::format("[{}]", part.count);
        if (std::isfinite(part.min) && std::isfinite(part.max))
            all += fmt::format(" {} to {}", part.min, part.max);
        else if (std::isfinite(part.min))
            all += fmt::format(" from {}", part.min);
        else if (std::isfinite(part.max))
            all += fmt::format(" to {}", part.max);
    }
    return all;
}

// Runs one episode in which all actions are 0. It ends after `limit` steps, or after 100 if there is no limit.
Expected<void> try_episode(const EpisodePlan& plan, std::uint64_t seed) {
    constexpr std::int64_t usual_steps = 100;
    auto episode = Episode::begin(plan, seed);
    if (!episode) return Unexpected(episode.error());
    const EnvironmentSpec& spec = (*episode)->spec();
    fmt::print("system       {}, {} ticks a step{}\naction       {}\nobservation  {}\n", spec.system, spec.ticks,
               spec.limit > 0 ? fmt::format(", at most {} steps", spec.limit) : "", visible(text_of(spec.action)),
               visible(text_of(spec.observation)));
    const std::vector<float> action(width_of(spec.action));
    std::vector<float> observation(width_of(spec.observation));
    if (auto ok = (*episode)->observe(observation); !ok) return ok;
    double reward = 0;
    std::int64_t steps = 0;
    bool terminated = false;
    while (!terminated && steps < (spec.limit > 0 ? spec.limit : usual_steps)) {
        const auto result = (*episode)->step(action, observation);
        if (!result) return Unexpected(result.error());
        reward += result->reward;
        terminated = result->terminated;
        ++steps;
    }
    fmt::print("tried        {} steps with action 0, seed {}: reward {:.6g}, {}\n", steps, seed, reward,
               terminated ? "terminated" : "not terminated");
    return {};
}

int run_environment(const EnvironmentOptions& options) {
    if (auto ok = need_simulation({{"environment", true}}); !ok) return refuse(ok.error());
    if (options.worlds < 1 || options.worlds > most_worlds)
        return refuse(fmt::format("--worlds: expected a number from 1 to {}, got {}", most_worlds, options.worlds));
    const std::uint64_t count = options.count.value_or(options.worlds - std::min(options.first, options.worlds));
    if (count < 1 || options.first >= options.worlds || count > options.worlds - options.first)
        return refuse(fmt::format(
            "--first and --count: expected at least one of the {} worlds, whose numbers begin with 0", options.worlds));
    const auto plan = plan_of(options.file);
    if (!options.memory) {
        const Expected<void> tried = plan ? try_episode(*plan, options.seed) : Unexpected(plan.error());
        return tried ? exit_done : refuse(tried.error());
    }
    // The program that started this process gets an error as JSON.
    const Expected<void> served = !plan ? Unexpected(plan.error())
                                        : serve_worlds(*plan,
                                                       {.memory = static_cast<int>(*options.memory),
                                                        .worlds = options.worlds,
                                                        .first = options.first,
                                                        .count = count,
                                                        .version = std::string(version())},
                                                       std::cin, std::cout);
    if (served) return exit_done;
    fmt::print("{{\"error\":{}}}\n", json_text(describe(served.error())));
    return exit_could_not_run;
}

}  // namespace

SubCommand environment_command() {
    auto options = std::make_shared<EnvironmentOptions>();
    return {.name = "environment",
            .help = "Try an environment for learning programs, or serve its worlds",
            .options = {{"FILE", &options->file, "a file with environment { ... }", "", {}, FileUse::source},
                        {"--seed", &options->seed, "the seed of the tried episode", "N"},
                        {"--worlds", &options->worlds, "number of worlds in the shared memory", "N"},
                        {"--first", &options->first, "number of the first world of this process", "N"},
                        {"--count", &options->count, "number of worlds of this process (default: the rest)", "N"},
                        {"--memory", &options->memory, "serve worlds: descriptor of the memory to share", "FD"}},
            .run = [options] { return run_environment(*options); },
            .footer =
                "Without --memory, this command runs one episode in which all actions are 0, and shows the result. The "
                "Python class\nnezumi_env.Vector starts it with --memory, and sends it commands."};
}

}  // namespace nezumi::cli
