// Runs scenario files in this process, with simulated worlds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/scenario/test_session.hpp"
#include "sim/world.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi {

inline TestSessionOptions simulated_session() {
    TestSessionOptions options;
    options.installed = {source_root()};
    options.systems = [] {
        return LiveOptions{.scripts = &lua_scripts(), .installed = {source_root()}, .world = sim::make_world};
    };
    return options;
}

/// A project of one file of scenarios.
class ScenarioRig {
public:
    explicit ScenarioRig(std::string_view text) : file_(folder_.write("it_test.lua", text)) {
        folder_.write("behaviors/none.lua", "param('x', 1)");
        options.folder = folder_.path("failures");
    }

    TestPlan plan(const std::string& filter = "") {
        auto planned =
            plan_tests({.paths = {file_}, .filter = filter, .seed = options.seed, .installed = options.installed});
        return planned ? std::move(*planned) : TestPlan{};
    }
    /// The result of its first run, without the files of a failure.
    RunResult run(const std::string& filter = "") {
        const TestPlan planned = plan(filter);
        if (planned.runs.empty()) return {.outcome = RunOutcome::could_not_run, .error = {"no run"}};
        RunResult result = run_planned(planned, planned.runs.front(), options, true);
        shorten(result.error.message);
        shorten(result.error.place.file);
        for (std::string& fact : result.facts) shorten(fact);
        return result;
    }
    SessionEnd session(const std::string& filter = "") {
        std::string text;
        const auto reporter = console_reporter([&text](std::string_view more) { text += more; }, false);
        SessionEnd end = run_tests(plan(filter), options, *reporter);
        said = std::move(text);
        return end;
    }

    const Scratch& folder() const { return folder_; }
    TestSessionOptions options = simulated_session();
    std::string said;  ///< of the last session

private:
    // Messages name files by their whole paths, which are others each time.
    void shorten(std::string& text) const {
        const std::string folder = file_.parent_path().string() + "/";
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
            text.erase(at, folder.size());
    }

    Scratch folder_;
    std::filesystem::path file_;
};

/// "passed", "failed: it_test.lua:3: ..." or "could not run: ...".
inline std::string outcome_of(const RunResult& result) {
    switch (result.outcome) {
        case RunOutcome::passed: return "passed";
        case RunOutcome::failed: return "failed: " + describe(result.error);
        case RunOutcome::could_not_run: break;
    }
    return "could not run: " + describe(result.error);
}

inline std::string outcome_of(std::string_view body) {
    return outcome_of(ScenarioRig("scenario('it', function(s)\n" + std::string(body) + "\nend)").run());
}

}  // namespace nezumi
