// Records every world from its first tick on, and draws it when the run is over.
#include "bindings/cli/scenario_files.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/picture.hpp"
#include "bindings/cli/recorder.hpp"
#include "bindings/cli/trajectories.hpp"

namespace nezumi::cli {
namespace {

class ScenarioFiles final : public RunFiles {
public:
    explicit ScenarioFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    Expected<void> begin(std::size_t world, const System&) override {
        const std::string number = world == 0 ? "" : fmt::format("_{}", world + 1);
        worlds_.push_back({"trace" + number + ".csv", "picture" + number + ".png", {}, {}, nullptr});
        return {};
    }

    // The trace begins with the first tick: until then words add to the world.
    void after_tick(std::size_t world, const System& system) override {
        World& kept = worlds_[world];
        if (kept.system == nullptr) {
            kept.system = &system;
            auto opened = Recorder::open((folder_ / kept.trace).string(), system, {});
            if (opened) {
                kept.recorder.emplace(std::move(*opened));
            } else if (!problem_) {
                problem_ = opened.error();
            }
        }
        if (kept.recorder) kept.recorder->add_row(system);
        kept.paths.look(system);
    }

    Kept finish(const std::string& title) override {
        Kept kept;
        const auto take = [&kept](const std::string& name, const Expected<void>& written) {
            if (written) {
                kept.names.push_back(name);
            } else {
                kept.problems.push_back(written.error());
            }
        };
        if (problem_) kept.problems.push_back(*problem_);
        for (World& world : worlds_) {
            if (world.recorder) take(world.trace, world.recorder->finish());
            // Without robots there is nothing to be seen.
            if (world.system == nullptr || world.system->robots().empty()) continue;
            take(world.picture,
                 draw_picture(look_at(*world.system, world.paths, title), (folder_ / world.picture).string()));
        }
        return kept;
    }

private:
    struct World {
        std::string trace;
        std::string picture;
        std::optional<Recorder> recorder;
        Paths paths;
        const System* system;  // null before its first tick
    };

    std::filesystem::path folder_;
    std::vector<World> worlds_;
    std::optional<Error> problem_;
};

}  // namespace

std::unique_ptr<RunFiles> scenario_files(const std::filesystem::path& folder) {
    return std::make_unique<ScenarioFiles>(folder);
}

}  // namespace nezumi::cli
