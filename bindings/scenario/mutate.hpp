// Changes one place of a behaviour at a time, and checks whether its scenarios notice the change.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/syntax/mutations.hpp"
#include "bindings/scenario/planned_run.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi {

/// A change, and the run that failed because of it.
struct TriedMutation {
    Mutation mutation;
    bool is_run = false;  ///< a scenario runs its line
    bool noticed = false;
    std::string by{};  ///< the name of the run
};

struct MutationReport {
    std::string file;  ///< as the project shows it
    std::vector<TriedMutation> tried;
    std::size_t runs = 0;  ///< number of runs that load the file
    bool interrupted = false;

    std::size_t noticed() const;
    /// "behaviors/keeper.lua:8: not noticed: ..." for each change that no scenario notices, and a summary.
    std::string text() const;
};

/// Makes all runs of the plan once without a change; they must pass. Then makes, for each change of the file, the runs
/// that execute its line, the quickest first, until one does not pass. `progress` may be empty.
Expected<MutationReport> mutate(const TestPlan& plan, const std::filesystem::path& file,
                                const TestSessionOptions& options);

}  // namespace nezumi
