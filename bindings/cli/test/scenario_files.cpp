// Records every world from its first tick on, and draws it after the run.
#include "bindings/cli/test/scenario_files.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/base/version.hpp"
#include "bindings/cli/run/journal.hpp"
#include "bindings/cli/run/recorder.hpp"
#include "bindings/draw/picture.hpp"
#include "bindings/draw/trajectories.hpp"
#include "bindings/journal/journal.hpp"
#include "engine/base/whole_file.hpp"
#include "sim/picture.hpp"

namespace nezumi::cli {
namespace {

class ScenarioFiles final : public RunFiles {
public:
    explicit ScenarioFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void begin(std::size_t world, RunningSystem& live, bool is_journaled) override {
        const std::string number = world == 0 ? "" : fmt::format("_{}", world + 1);
        worlds_.push_back({"trace" + number + ".csv", "picture" + number + ".png", live});
        // One journal is enough to look at the failure.
        if (!is_journaled || world != 0) return;
        auto journal = Journal::create(folder_ / failure_journal);
        if (!journal) return;
        worlds_.back().journal = std::move(*journal);
        worlds_.back().journal->begin(live, version(), false);
    }

    void begin_recorded(std::size_t world, RunningSystem& live, const std::filesystem::path& recording) override {
        begin(world, live, false);
        std::error_code none;
        if (world == 0) worlds_.back().recording = std::filesystem::absolute(recording, none);
    }

    void drop_journal(std::size_t world) override { drop(worlds_[world]); }

    // The trace starts with the first tick: before it, the scenario may still add components.
    void after_tick(std::size_t world) override {
        World& kept = worlds_[world];
        const System& system = kept.live.system();
        if (!std::exchange(kept.begun, true)) {
            auto opened = Recorder::open((folder_ / kept.trace).string(), kept.live.trace(), system, {});
            if (opened) {
                kept.recorder.emplace(std::move(*opened));
            } else if (!problem_) {
                problem_ = opened.error();
            }
        }
        if (kept.journal) kept.journal->serve();
        if (kept.recorder) kept.recorder->add_rows(system);
        kept.trajectories.add(system, kept.live.trace());
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
            if (world.journal) {
                world.live.observe_acts(nullptr);
                world.journal->end(RunEnd::duration, "", world.live.when(), world.live.trace_hash());
                if (!world.journal->error()) kept.names.emplace_back(failure_journal);
            }
            if (!world.recording.empty()) {
                const ActTime when = world.live.when();
                take(std::string(failed_recording),
                     write_whole(folder_ / failed_recording,
                                 fmt::format("{}\n{} {}\n", world.recording.string(), when.start, when.tick)));
            }
            if (world.recorder) take(world.trace, world.recorder->finish());
            // Without simulated robots there is nothing to draw.
            const System& system = world.live.system();
            if (!world.begun || system.world() == nullptr || system.robots().empty()) continue;
            take(world.picture, draw::draw_picture(draw::look_at(world.live, world.trajectories, title),
                                                   (folder_ / world.picture).string(), sim::read_picture));
        }
        return kept;
    }

private:
    struct World {
        std::string trace;
        std::string picture;
        RunningSystem& live;
        std::optional<Recorder> recorder{};
        draw::Trajectories trajectories{};
        bool begun = false;  // the first tick has passed
        std::unique_ptr<Journal> journal{};
        std::filesystem::path recording{};  // "": it is a simulation
    };

    static void drop(World& world) {
        if (world.journal == nullptr) return;
        world.live.observe_acts(nullptr);
        world.journal.reset();
    }

    std::filesystem::path folder_;
    std::vector<World> worlds_;
    std::optional<Error> problem_;
};

}  // namespace

std::unique_ptr<RunFiles> scenario_files(const std::filesystem::path& folder) {
    return std::make_unique<ScenarioFiles>(folder);
}

}  // namespace nezumi::cli
